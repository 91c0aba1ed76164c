// SPDX-License-Identifier: MIT OR Apache-2.0
//! Proofs about emitted blocks: Yosys writes the transition relation, yosys-smtbmc and z3 look for a counterexample
//! (`docs/prove.md`).
//!
//! | module       | what it does                                                     |
//! |--------------|------------------------------------------------------------------|
//! | [`contract`] | what each block promises on its streams, and parts of blocks      |
//! | [`wrapper`]  | a module round a block that says so in assertions, and its faults |
//! | [`solve`]    | runs Yosys and the solver                                        |

pub mod contract;
pub mod solve;
pub mod wrapper;

/// What is proved of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Property {
    /// While `out_valid` stands and `out_ready` does not, `out_valid` and the payload stay.
    Held,
    /// Neither `out_valid` nor the payload follows `out_ready` within a cycle.
    Free,
    /// No answer without a request, and no more requests under way than the block holds: nothing is sent twice.
    Counted,
    /// While requests are under way, `out_valid` rises within so many cycles: nothing is lost, and nothing hangs.
    Answered,
    /// The payload is what an independent formula says.
    Equal,
    /// Nothing is pushed into a full queue or memory, nor taken from an empty one.
    Room,
    /// A beat that had to wait is taken, and states are reached: the proofs above are about something.
    Reached,
}

impl Property {
    /// All of them.
    pub const ALL: [Property; 7] = [
        Property::Held,
        Property::Free,
        Property::Counted,
        Property::Answered,
        Property::Equal,
        Property::Room,
        Property::Reached,
    ];

    /// The name, as `--property` takes it and as labels have it.
    pub const fn name(self) -> &'static str {
        match self {
            Property::Held => "held",
            Property::Free => "free",
            Property::Counted => "counted",
            Property::Answered => "answered",
            Property::Equal => "equal",
            Property::Room => "room",
            Property::Reached => "reached",
        }
    }
}

impl std::str::FromStr for Property {
    type Err = String;
    fn from_str(name: &str) -> Result<Property, String> {
        Property::ALL.into_iter().find(|property| property.name() == name).ok_or_else(|| {
            let names = Property::ALL.map(Property::name).join(", ");
            format!("there is no property `{name}`; {names} are")
        })
    }
}
