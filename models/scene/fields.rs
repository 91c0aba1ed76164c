// SPDX-License-Identifier: MIT OR Apache-2.0
//! The fields of a scene file as they stand there. `serde` refuses unknown ones by name.

use std::fmt;
use std::marker::PhantomData;

use serde::de::{Error, IgnoredAny, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use toml::Spanned;

use crate::body::UvSource;
use crate::map::{Procedural, Wrap};
use crate::rules::{ExtremumRule, FootprintRule};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Scene {
    pub(super) camera: Spanned<Camera>,
    pub(super) remesh: Option<Spanned<Remesh>>,
    #[serde(default)]
    pub(super) object: Vec<Spanned<Object>>,
    #[serde(default)]
    pub(super) light: Vec<Spanned<Light>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Camera {
    pub(super) eye: Exactly<f64, 3>,
    pub(super) target: Option<Exactly<f64, 3>>,
    pub(super) up: Option<Exactly<f64, 3>>,
    pub(super) fov_y_deg: Option<f64>,
    pub(super) near: Option<f64>,
    pub(super) far: Option<f64>,
    pub(super) viewport: Option<Exactly<i64, 2>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Remesh {
    pub(super) cell_px: Option<f64>,
    pub(super) cull: Option<bool>,
    pub(super) footprint: Option<FootprintRule>,
    pub(super) extremum: Option<ExtremumRule>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Object {
    pub(super) mesh: Mesh,
    pub(super) map: Map,
    pub(super) displacement: Option<Exactly<f64, 2>>,
    pub(super) wrap: Option<Exactly<Wrap, 2>>,
    pub(super) at: Option<Exactly<f64, 3>>,
    pub(super) colour: Option<Exactly<f64, 3>>,
}

/// A body or a file; which of the fields belong together is decided when it is resolved.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Mesh {
    pub(super) kind: Option<Kind>,
    pub(super) cells: Option<Exactly<i64, 2>>,
    pub(super) size: Option<Exactly<f64, 2>>,
    pub(super) radius: Option<f64>,
    pub(super) height: Option<f64>,
    pub(super) file: Option<String>,
    pub(super) uv: Option<UvSource>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Kind {
    Grid,
    Cylinder,
    Sphere,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Map {
    pub(super) kind: Option<Procedural>,
    pub(super) size: Option<Exactly<i64, 2>>,
    pub(super) file: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Light {
    pub(super) direction: Exactly<f64, 3>,
}

/// As many values as there have to be: what is too much would be ignored in an array.
#[derive(Clone, Copy)]
pub(super) struct Exactly<T, const N: usize>(pub(super) [T; N]);

impl<'de, T: Deserialize<'de>, const N: usize> Deserialize<'de> for Exactly<T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(ExactlyVisitor(PhantomData))
    }
}

struct ExactlyVisitor<T, const N: usize>(PhantomData<T>);

impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for ExactlyVisitor<T, N> {
    type Value = Exactly<T, N>;
    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "an array of length {N}")
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut values: A) -> Result<Self::Value, A::Error> {
        let mut taken = Vec::with_capacity(N);
        while taken.len() < N
            && let Some(value) = values.next_element()?
        {
            taken.push(value);
        }
        let mut count = taken.len();
        while values.next_element::<IgnoredAny>()?.is_some() {
            count += 1;
        }
        let wrong = |_| A::Error::invalid_length(count, &self);
        if count > N { Err(wrong(taken)) } else { taken.try_into().map(Exactly).map_err(wrong) }
    }
}
