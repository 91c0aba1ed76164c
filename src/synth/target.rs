// SPDX-License-Identifier: MIT OR Apache-2.0
//! The parts that blocks are synthesized for.

/// What every part has, whatever its cells are called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Resource {
    /// Look-up tables, those that carry chains and distributed RAM take among them.
    Lut,
    /// Flip-flops.
    FlipFlop,
    /// Block RAMs.
    BlockRam,
    /// Multipliers.
    Dsp,
}

/// How a part is placed and routed.
#[derive(Clone, Copy, Debug)]
pub struct Route {
    /// The program.
    pub program: &'static str,
    /// What names the part to it.
    pub arguments: &'static [&'static str],
    /// What the file `pins.cst` holds, where the program wants every pin placed.
    pub pins: Option<&'static str>,
}

/// A part.
#[derive(Debug)]
pub struct Target {
    /// The name that `--target` takes.
    pub name: &'static str,
    /// The part, as documents name it.
    pub part: &'static str,
    /// The pass of Yosys.
    pub pass: &'static str,
    /// Options of the pass for a module that is placed in another one.
    pub inner: &'static str,
    /// Whether Debian's Yosys 0.23 is too old for its memories and multipliers.
    pub new_yosys: bool,
    /// What the part holds of LUT, flip-flop, block RAM and DSP; none for a family.
    pub holds: Option<[usize; 4]>,
    /// What block RAMs and DSPs are called: the unit of the counts.
    pub units: [&'static str; 2],
    /// How it is placed and routed, or why it is not.
    pub route: Result<Route, &'static str>,
    /// The clock that a block shall reach, MHz.
    pub goal_mhz: Option<f64>,
    /// What a kind of cell takes, and how many of it.
    cell: fn(&str) -> Option<(Resource, usize)>,
}

impl Target {
    /// What a kind of cell takes, and how many of it; none for wiring.
    pub fn cell(&self, kind: &str) -> Option<(Resource, usize)> {
        (self.cell)(kind)
    }
}

use Resource::{BlockRam, Dsp, FlipFlop, Lut};

const ECP5_UNITS: [&str; 2] = ["DP16KD", "MULT18X18D"];

fn ecp5(kind: &str) -> Option<(Resource, usize)> {
    Some(match kind {
        "LUT4" => (Lut, 1),
        "CCU2C" => (Lut, 2),
        "TRELLIS_DPR16X4" => (Lut, 4),
        "TRELLIS_FF" => (FlipFlop, 1),
        "DP16KD" | "PDPW16KD" => (BlockRam, 1),
        "MULT18X18D" => (Dsp, 1),
        _ => return None,
    })
}

fn ice40(kind: &str) -> Option<(Resource, usize)> {
    Some(match kind {
        "SB_LUT4" => (Lut, 1),
        "SB_MAC16" => (Dsp, 1),
        _ if kind.starts_with("SB_DFF") => (FlipFlop, 1),
        _ if kind.starts_with("SB_RAM40_4K") => (BlockRam, 1),
        _ => return None,
    })
}

fn xc7(kind: &str) -> Option<(Resource, usize)> {
    Some(match kind {
        "LUT1" | "LUT2" | "LUT3" | "LUT4" | "LUT5" | "LUT6" | "SRL16E" | "SRLC32E" => (Lut, 1),
        "RAM32X1D" | "RAM64X1D" => (Lut, 2),
        "RAM32M" | "RAM64M" | "RAM128X1D" => (Lut, 4),
        "FDRE" | "FDSE" | "FDCE" | "FDPE" => (FlipFlop, 1),
        "RAMB18E1" => (BlockRam, 1),
        "RAMB36E1" => (BlockRam, 2),
        "DSP48E1" => (Dsp, 1),
        _ => return None,
    })
}

fn gowin(kind: &str) -> Option<(Resource, usize)> {
    Some(match kind {
        "LUT1" | "LUT2" | "LUT3" | "LUT4" | "ALU" => (Lut, 1),
        "RAM16S1" | "RAM16SDP1" => (Lut, 1),
        "RAM16S2" | "RAM16SDP2" => (Lut, 2),
        "RAM16S4" | "RAM16SDP4" => (Lut, 4),
        "SP" | "SPX9" | "SDPB" | "SDPX9B" | "DPB" | "DPX9B" | "pROM" | "pROMX9" => (BlockRam, 1),
        "MULT9X9" | "MULT18X18" | "MULT36X36" | "MULTADDALU18X18" | "MULTALU36X18" | "MULTALU18X18" => (Dsp, 1),
        _ if kind.starts_with("DFF") => (FlipFlop, 1),
        _ => return None,
    })
}

const fn ecp5_route(arguments: &'static [&'static str]) -> Result<Route, &'static str> {
    Ok(Route { program: "nextpnr-ecp5", arguments, pins: None })
}

const fn ice40_route(arguments: &'static [&'static str]) -> Result<Route, &'static str> {
    Ok(Route { program: "nextpnr-ice40", arguments, pins: None })
}

/// Every part.
pub const TARGETS: &[Target] = &[
    Target {
        name: "ecp5-85k",
        part: "Lattice LFE5U-85F, speed grade 6",
        pass: "synth_ecp5 -nowidelut",
        inner: "",
        new_yosys: false,
        holds: Some([83_640, 83_640, 208, 156]),
        units: ECP5_UNITS,
        route: ecp5_route(&["--85k", "--speed", "6", "--package", "CABGA756", "--lpf-allow-unconstrained"]),
        goal_mhz: Some(125.0),
        cell: ecp5,
    },
    Target {
        name: "ecp5-25k",
        part: "Lattice LFE5U-25F, speed grade 6",
        pass: "synth_ecp5 -nowidelut",
        inner: "",
        new_yosys: false,
        holds: Some([24_288, 24_288, 56, 28]),
        units: ECP5_UNITS,
        route: ecp5_route(&["--25k", "--speed", "6", "--package", "CABGA381", "--lpf-allow-unconstrained"]),
        goal_mhz: None,
        cell: ecp5,
    },
    Target {
        name: "ice40-up5k",
        part: "Lattice iCE40UP5K",
        pass: "synth_ice40 -dsp",
        inner: "",
        new_yosys: false,
        holds: Some([5_280, 5_280, 30, 8]),
        units: ["SB_RAM40_4K", "SB_MAC16"],
        route: ice40_route(&["--up5k", "--package", "sg48"]),
        goal_mhz: None,
        cell: ice40,
    },
    Target {
        name: "ice40-hx8k",
        part: "Lattice iCE40HX8K",
        pass: "synth_ice40",
        inner: "",
        new_yosys: false,
        holds: Some([7_680, 7_680, 32, 0]),
        units: ["SB_RAM40_4K", "SB_MAC16"],
        route: ice40_route(&["--hx8k", "--package", "ct256"]),
        goal_mhz: None,
        cell: ice40,
    },
    Target {
        name: "xc7",
        part: "AMD 7 series",
        pass: "synth_xilinx -family xc7 -flatten",
        inner: "-noiopad",
        new_yosys: false,
        holds: None,
        units: ["RAMB18E1", "DSP48E1"],
        route: Err(
            "neither PyPI nor Debian has a place and route for the 7 series with the data of its parts, so this \
                    target has synthesis only",
        ),
        goal_mhz: None,
        cell: xc7,
    },
    Target {
        name: "gowin",
        part: "Gowin GW2A-18, C8/I7",
        pass: "synth_gowin -family gw2a",
        inner: "-noiopads",
        new_yosys: true,
        holds: Some([20_736, 15_552, 46, 48]),
        units: ["BSRAM", "MULT18X18"],
        route: Ok(Route {
            program: "nextpnr-himbaechel-gowin",
            arguments: &["--device", "GW2A-LV18PG256C8/I7", "--vopt", "family=GW2A-18", "--vopt", "cst=pins.cst"],
            pins: Some(
                "IO_LOC \"clock\" H11;\nIO_LOC \"reset\" T10;\nIO_LOC \"serial_in\" T11;\nIO_LOC \"serial_out\" T12;\n",
            ),
        }),
        goal_mhz: None,
        cell: gowin,
    },
];

/// The part of a name.
///
/// # Errors
/// A sentence that names all of them.
pub fn find(name: &str) -> Result<&'static Target, String> {
    let names = || TARGETS.iter().map(|target| target.name).collect::<Vec<_>>().join(", ");
    let found = TARGETS.iter().find(|target| target.name == name);
    found.ok_or_else(|| format!("there is no target `{name}`; --target takes {}", names()))
}
