// SPDX-License-Identifier: MIT OR Apache-2.0
//! Records, trims, reads and draws waveforms.
//!
//! | module        | from                        | to                                   |
//! |---------------|-----------------------------|--------------------------------------|
//! | [`tree`]      | names, widths and kinds     | the word layout of a sample          |
//! | [`record`]    | samples, one a clock cycle  | a VCD file, whole or round a trigger |
//! | [`mod@read`]  | a VCD or FST file           | values as each rising edge sees them |
//! | [`mod@trim`]  | a VCD or FST file           | a VCD file of a few cycles           |
//! | [`mod@draw`]  | values, rows to show        | an SVG picture for a document        |
//! | [`mod@gtkw`]  | a tree, groups and formats  | a GTKWave save file                  |
//!
//! The crate knows nothing of any hardware description: who simulates hands over words.
//!
//! # Time
//! A cycle is the time up to and including the rising edge that ends it, so the value of a signal *in* cycle `c` is
//! what that edge samples. A recorded cycle `c` spans 10 ns from `10 * c`: the clock rises there, the values of the
//! cycle follow at the same instant, the clock falls half-way, and the edge that samples them is at `10 * (c + 1)`.

pub mod draw;
pub mod gtkw;
pub mod read;
pub mod record;
pub mod tree;
pub mod trim;

pub use draw::{Drawing, Label, Row, Stream, draw};
pub use gtkw::{Format, Group, gtkw};
pub use read::{Trace, Value, Waves, read, read_with_clock};
pub use record::VcdRecorder;
pub use tree::{Item, Kind, Scope, Signal, SignalTree, TreeError};
pub use trim::trim;
