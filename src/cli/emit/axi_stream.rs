// SPDX-License-Identifier: MIT OR Apache-2.0
//! A block under the port names of AXI4-Stream: wires only, so nothing is added to its timing but the inverted reset.
//!
//! TDATA holds every field of the stream side by side, the first one in the lowest bits, as `in.hex` and `out.hex` do, and
//! zeros up to a whole number of bytes. The field `out_last` or `out_end` also goes to TLAST. Status is no part of a stream.

use super::width;
use std::fmt::Write;

type Field<'a> = (&'a str, usize);
type Fields<'a> = [Field<'a>];

/// The fields that travel in TDATA, and those that are status.
fn parts<'a>(out_fields: &Fields<'a>) -> (Vec<Field<'a>>, Vec<Field<'a>>) {
    out_fields.iter().partition(|(name, _)| name.starts_with("out_"))
}

/// Bits of a TDATA.
fn tdata(fields: &Fields<'_>) -> usize {
    width(fields).div_ceil(8) * 8
}

/// Where each field lies: `[1:0] in_kind`.
fn places(fields: &Fields<'_>) -> String {
    let mut from = 0;
    let place = |(name, bits): &(&str, usize)| {
        from += bits;
        match bits {
            1 => format!("[{}] {name}", from - 1),
            _ => format!("[{}:{}] {name}", from - 1, from - bits),
        }
    };
    fields.iter().map(place).collect::<Vec<_>>().join(", ")
}

/// The text of `relief_<block>_axis.sv`.
pub fn wrapper(top: &str, in_fields: &Fields<'_>, out_fields: &Fields<'_>) -> String {
    let (payload, status) = parts(out_fields);
    let last = payload.iter().map(|(name, _)| *name).find(|name| ["out_last", "out_end"].contains(name));
    let (in_bits, out_bits) = (tdata(in_fields), tdata(&payload));
    let mut ports = vec![
        "input  wire aclk".to_owned(),
        "input  wire aresetn, // synchronous to aclk".to_owned(),
        "input  wire s_axis_tvalid".to_owned(),
        "output wire s_axis_tready".to_owned(),
        format!("input  wire [{}:0] s_axis_tdata", in_bits - 1),
        "output wire m_axis_tvalid".to_owned(),
        "input  wire m_axis_tready".to_owned(),
        format!("output wire [{}:0] m_axis_tdata", out_bits - 1),
    ];
    ports.extend(last.map(|_| "output wire m_axis_tlast".to_owned()));
    let range = |bits: usize| if bits == 1 { String::new() } else { format!("[{}:0] ", bits - 1) };
    ports.extend(status.iter().map(|(name, bits)| format!("output wire {}{name}", range(*bits))));
    // The comma stands before a comment.
    let ports: Vec<String> = ports.into_iter().map(|port| port.replacen(", //", " //", 1)).collect();
    let count = ports.len();
    let lines = ports.into_iter().enumerate().map(|(at, port)| {
        let comma = if at + 1 < count { "," } else { "" };
        match port.split_once(" //") {
            Some((code, comment)) => format!("    {code}{comma} //{comment}"),
            None => format!("    {port}{comma}"),
        }
    });
    let mut text = format!(
        "// SPDX-License-Identifier: MIT OR Apache-2.0\n// {top} under the port names of AXI4-Stream. Written by `relief emit \
         --axi-stream`.\n//\n// s_axis_tdata: {}\n// m_axis_tdata: {}\n`default_nettype none\n\nmodule {top}_axis (\n{}\n);\n",
        places(in_fields),
        places(&payload),
        lines.collect::<Vec<_>>().join("\n")
    );
    let mut connections: Vec<String> = [
        ("clock", "aclk"),
        ("reset", "!aresetn"),
        ("in_valid", "s_axis_tvalid"),
        ("in_ready", "s_axis_tready"),
        ("out_valid", "m_axis_tvalid"),
        ("out_ready", "m_axis_tready"),
    ]
    .map(|(port, wire)| format!(".{port}({wire})"))
    .to_vec();
    let mut from = 0;
    for (name, bits) in in_fields {
        let part = if *bits == 1 { format!("[{from}]") } else { format!("[{}:{from}]", from + bits - 1) };
        connections.push(format!(".{name}(s_axis_tdata{part})"));
        from += bits;
    }
    if from < in_bits {
        let part = if from + 1 == in_bits { format!("[{from}]") } else { format!("[{}:{from}]", in_bits - 1) };
        let _ = writeln!(text, "    wire unused = &{{1'b0, s_axis_tdata{part}}};");
    }
    for (name, bits) in &payload {
        let _ = writeln!(text, "    wire {}{name};", range(*bits));
        connections.push(format!(".{name}({name})"));
    }
    connections.extend(status.iter().map(|(name, _)| format!(".{name}({name})")));
    let mut side_by_side: Vec<String> = payload.iter().rev().map(|(name, _)| (*name).to_owned()).collect();
    if width(&payload) < out_bits {
        side_by_side.insert(0, format!("{}'d0", out_bits - width(&payload)));
    }
    let _ = writeln!(text, "    assign m_axis_tdata = {{{}}};", side_by_side.join(", "));
    if let Some(last) = last {
        let _ = writeln!(text, "    assign m_axis_tlast = {last};");
    }
    let _ = write!(
        text,
        "\n    {top} block (\n        {}\n    );\n\nendmodule\n\n`default_nettype wire\n",
        connections.join(",\n        ")
    );
    text
}

/// The wrapper in the place of the block in the test bench.
pub fn instance(top: &str, in_fields: &Fields<'_>, out_fields: &Fields<'_>) -> String {
    let (payload, status) = parts(out_fields);
    let (bits, in_pad) = (width(&payload), tdata(in_fields) - width(in_fields));
    let in_data = if in_pad == 0 { "in_beat".to_owned() } else { format!("{{{in_pad}'d0, in_beat}}") };
    let mut connect = format!(
        "  wire [{}:0] tdata;\n  assign out_beat[0 +: {bits}] = tdata[0 +: {bits}];\n  {top}_axis dut (\n    .aclk(clock),\n    \
         .aresetn(!reset),\n    .s_axis_tvalid(in_valid),\n    .s_axis_tready(in_ready),\n    .s_axis_tdata({in_data}),\n    \
         .m_axis_tvalid(out_valid),\n    .m_axis_tready(out_ready),\n    .m_axis_tdata(tdata)",
        tdata(&payload) - 1
    );
    if payload.iter().any(|(name, _)| ["out_last", "out_end"].contains(name)) {
        connect += ",\n    .m_axis_tlast()";
    }
    // Status stands behind the streams.
    let mut from = bits;
    for (name, bits) in status {
        let _ = write!(connect, ",\n    .{name}(out_beat[{from} +: {bits}])");
        from += bits;
    }
    connect + "\n  );"
}
