# SPDX-License-Identifier: MIT OR Apache-2.0
"""Random vertices through the vertex adder, under idle cycles and backpressure, against one line of Python."""

import random

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import FallingEdge, ReadOnly, RisingEdge

LANES = 9
BEATS = 200


def pack(lanes, bits):
    """Component 0 in the lowest bits, each in two's complement."""
    return sum((lane & ((1 << bits) - 1)) << (at * bits) for at, lane in enumerate(lanes))


async def reset(dut):
    """One rising edge is enough; nothing is offered before it."""
    dut.in_valid.value = 0
    dut.out_ready.value = 0
    dut.reset.value = 1
    await RisingEdge(dut.clock)
    await FallingEdge(dut.clock)
    dut.reset.value = 0


async def send(dut, beats, rng):
    """A beat once offered stays until it is taken. Inputs change at the falling edge."""
    for vertex, difference in beats:
        while rng.random() < 0.3:
            await FallingEdge(dut.clock)
        dut.in_valid.value = 1
        dut.in_vertex.value = vertex
        dut.in_difference.value = difference
        taken = False
        while not taken:
            await ReadOnly()
            taken = bool(dut.in_ready.value)
            await FallingEdge(dut.clock)
        dut.in_valid.value = 0


async def receive(dut, count, rng):
    beats = []
    while len(beats) < count:
        dut.out_ready.value = rng.random() >= 0.4
        await ReadOnly()
        if dut.out_valid.value and dut.out_ready.value:
            beats.append(dut.out_vertex.value.to_unsigned())
        await FallingEdge(dut.clock)
    dut.out_ready.value = 0
    return beats


@cocotb.test(timeout_time=100, timeout_unit="us")
async def sums_are_right(dut):
    bits = len(dut.in_vertex) // LANES
    rng = random.Random(1)
    low, high = -(1 << (bits - 1)), (1 << (bits - 1)) - 1

    def component():
        return rng.choice([low, high, 0, -1, rng.randint(low, high), rng.randint(low, high)])

    pairs = [([component() for _ in range(LANES)], [component() for _ in range(LANES)]) for _ in range(BEATS)]
    expected = [pack([a + b for a, b in zip(*pair)], bits) for pair in pairs]

    cocotb.start_soon(Clock(dut.clock, 10, "ns").start())
    await reset(dut)
    beats = [(pack(vertex, bits), pack(difference, bits)) for vertex, difference in pairs]
    cocotb.start_soon(send(dut, beats, rng))
    assert await receive(dut, BEATS, rng) == expected
