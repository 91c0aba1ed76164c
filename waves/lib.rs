// SPDX-License-Identifier: MIT OR Apache-2.0
//! Records, trims, reads and draws waveforms.
