// SPDX-License-Identifier: MIT OR Apache-2.0
//! From what files say to a [`Mesh`]: vertices by exact coordinates, triangles in the order of their base triangles.

use std::hash::{Hash, Hasher};

use hashbrown::HashTable;
use rustc_hash::{FxHashMap, FxHasher};

use super::exact::{Radix, Scaled};
use super::points::{NARROW_LIMIT, Points, Unit};
use super::{Bases, InputError, Mesh, Place, Progress};

/// Three half-edges a triangle are numbered in 32 bits.
const MOST_TRIANGLES: usize = u32::MAX as usize / 3;

/// Gives equal keys equal numbers, counted from 0 in the order of their first appearance.
///
/// The table holds numbers only and compares through `keys`: 5 bytes a slot instead of 32.
pub(crate) struct Interner<K> {
    pub(crate) keys: Vec<K>,
    table: HashTable<u32>,
}

impl<K: Hash + Eq + Copy> Interner<K> {
    pub(crate) fn new() -> Interner<K> {
        Interner { keys: Vec::new(), table: HashTable::new() }
    }

    /// The number of `key`; `None` once 2^32 - 1 keys are in use.
    #[inline]
    pub(crate) fn intern(&mut self, key: K) -> Option<u32> {
        let Interner { keys, table } = self;
        let entry = table.entry(hash(&key), |found| keys[*found as usize] == key, |moved| hash(&keys[*moved as usize]));
        match entry {
            hashbrown::hash_table::Entry::Occupied(found) => Some(*found.get()),
            hashbrown::hash_table::Entry::Vacant(free) => {
                let number = u32::try_from(keys.len()).ok().filter(|number| *number != u32::MAX)?;
                keys.push(key);
                free.insert(number);
                Some(number)
            }
        }
    }
}

#[inline]
fn hash<K: Hash>(key: &K) -> u64 {
    let mut hasher = FxHasher::default();
    key.hash(&mut hasher);
    hasher.finish()
}

/// A base triangle on its way: named by a triangle, or given with its corners.
struct BaseSlot {
    name: u32,
    corners: Option<[[Scaled; 3]; 3]>,
    place: Place,
}

/// Builds a mesh of base triangles and emitted triangles, as the text format holds them.
///
/// Emitted coordinates are integers over `scale`, base corners are whole units.
pub struct Builder {
    file: String,
    scale: u64,
    vertices: Interner<[i64; 3]>,
    numbers: FxHashMap<u32, u32>,
    bases: Vec<BaseSlot>,
    triangles: Vec<[u32; 3]>,
    base_of: Vec<u32>,
}

impl Builder {
    /// An empty mesh of emitted coordinates over `scale`; `name` stands in error messages for a file.
    pub fn new(name: &str, scale: u64) -> Builder {
        Builder {
            file: name.to_owned(),
            scale,
            vertices: Interner::new(),
            numbers: FxHashMap::default(),
            bases: Vec::new(),
            triangles: Vec::new(),
            base_of: Vec::new(),
        }
    }

    /// Adds base triangle `base` with its corners in winding order.
    pub fn base(&mut self, base: u32, corners: [[i64; 3]; 3]) -> Result<(), InputError> {
        let corners = corners.map(|corner| corner.map(|value| Scaled::from_integer(value, Radix::Ten)));
        self.scaled_base(base, corners, Place::File)
    }

    /// Adds an emitted triangle of base triangle `base`, which may be added later.
    pub fn triangle(&mut self, base: u32, corners: [[i64; 3]; 3]) -> Result<(), InputError> {
        let number = self.number(base, Place::File)?;
        let mut vertices = [0; 3];
        for (vertex, corner) in vertices.iter_mut().zip(corners) {
            *vertex = self.vertex(corner)?;
        }
        self.push(number, vertices)
    }

    pub(super) fn set_scale(&mut self, scale: u64) {
        self.scale = scale;
    }

    /// The number of a base triangle, which is new if no line has named it.
    pub(super) fn number(&mut self, name: u32, place: Place) -> Result<u32, InputError> {
        if let Some(number) = self.numbers.get(&name) {
            return Ok(*number);
        }
        // Names are u32 themselves, so their number fits into one except for the very last.
        let number = u32::try_from(self.bases.len()).map_err(|_| self.error(place, "has too many base triangles"))?;
        self.numbers.insert(name, number);
        self.bases.push(BaseSlot { name, corners: None, place });
        Ok(number)
    }

    pub(super) fn scaled_base(&mut self, name: u32, corners: [[Scaled; 3]; 3], place: Place) -> Result<(), InputError> {
        let number = self.number(name, place)?;
        let slot = &mut self.bases[number as usize];
        if slot.corners.is_some() {
            let message = format!("base triangle {name} is given a second time; each `b` line needs its own number");
            return Err(self.error(place, &message));
        }
        slot.corners = Some(corners);
        slot.place = place;
        Ok(())
    }

    #[inline]
    pub(super) fn vertex(&mut self, corner: [i64; 3]) -> Result<u32, InputError> {
        if corner.iter().any(|value| value.unsigned_abs() >= NARROW_LIMIT as u64) {
            return Err(self.error(Place::File, "has an emitted coordinate of 2^61 or more, which is not supported"));
        }
        match self.vertices.intern(corner) {
            Some(vertex) => Ok(vertex),
            None => Err(self.error(Place::File, "has 2^32 vertices or more, which is not supported")),
        }
    }

    #[inline]
    pub(super) fn push(&mut self, base: u32, vertices: [u32; 3]) -> Result<(), InputError> {
        if self.triangles.len() >= MOST_TRIANGLES {
            return Err(self.error(Place::File, "has 2^32 / 3 triangles or more, which is not supported"));
        }
        self.triangles.push(vertices);
        self.base_of.push(base);
        Ok(())
    }

    fn error(&self, place: Place, message: &str) -> InputError {
        InputError::new(&self.file, place, message)
    }

    /// Brings base and emitted coordinates onto one lattice and hands out the mesh.
    pub fn finish(self) -> Result<Mesh, InputError> {
        if self.bases.is_empty() {
            return Err(self.error(Place::File, "holds no base triangle; lines `b I x y z x y z x y z` are expected"));
        }
        if let Some(slot) = self.bases.iter().find(|slot| slot.corners.is_none()) {
            let message =
                format!("base triangle {0} has no corners; a line `b {0} x y z x y z x y z` is missing", slot.name);
            return Err(self.error(slot.place, &message));
        }
        let Builder { file, scale, mut vertices, bases, triangles, base_of, .. } = self;
        let refinement = refinement(&file, scale, &bases)?;
        if refinement > 1 {
            let mut refined = Interner::new();
            for vertex in &vertices.keys {
                let mut key = [0; 3];
                for (refined, value) in key.iter_mut().zip(vertex) {
                    *refined = narrow(i128::from(*value) * i128::from(refinement))
                        .ok_or_else(|| too_fine(&file, Place::File, refinement))?;
                }
                // Distinct vertices stay distinct and keep their order, so their numbers stay too.
                refined.intern(key);
            }
            vertices = refined;
        }
        let mut corners = Vec::with_capacity(bases.len());
        for slot in &bases {
            let mut triangle = [0; 3];
            for (vertex, corner) in triangle.iter_mut().zip(slot.corners.iter().flatten()) {
                let mut key = [0; 3];
                for (coordinate, number) in key.iter_mut().zip(corner) {
                    *coordinate =
                        lattice(*number, scale, refinement).ok_or_else(|| too_fine(&file, slot.place, refinement))?;
                }
                *vertex = vertices
                    .intern(key)
                    .ok_or_else(|| InputError::new(&file, slot.place, "has 2^32 vertices or more"))?;
            }
            corners.push(triangle);
        }
        let points = Points::from_lattice(vertices.keys, Unit::Fraction { scale, refinement });
        let names: Vec<u32> = bases.iter().map(|slot| slot.name).collect();
        let (triangles, first) = by_base(triangles, base_of, names.len());
        Ok(Mesh { points, triangles, bases: Some(Bases { names, corners, first }) })
    }
}

fn too_fine(file: &str, place: Place, refinement: u64) -> InputError {
    let message = format!(
        "a coordinate does not fit below 2^61 steps of 1/(scale * {refinement}), the lattice of all coordinates; \
         smaller coordinates or fewer decimals in `b` lines are needed"
    );
    InputError::new(file, place, message)
}

fn narrow(value: i128) -> Option<i64> {
    i64::try_from(value).ok().filter(|value| value.unsigned_abs() < NARROW_LIMIT as u64)
}

fn greatest_common_divisor(mut a: u128, mut b: u128) -> u128 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

/// The smallest factor that makes every base corner an integer over `scale * factor`.
fn refinement(file: &str, scale: u64, bases: &[BaseSlot]) -> Result<u64, InputError> {
    let mut factor = 1u128;
    for slot in bases {
        for number in slot.corners.iter().flatten().flatten().filter(|number| number.exponent < 0) {
            // |mantissa| < 2^60 and scale < 2^61: the product fits.
            let numerator = u128::from(number.mantissa.unsigned_abs()) * u128::from(scale);
            factor = 10u128
                .checked_pow(number.exponent.unsigned_abs().into())
                .map(|denominator| denominator / greatest_common_divisor(numerator, denominator))
                .and_then(|needed| factor.checked_mul(needed / greatest_common_divisor(factor, needed)))
                .filter(|factor| *factor < NARROW_LIMIT as u128)
                .ok_or_else(|| too_fine(file, slot.place, 1))?;
        }
    }
    Ok(factor as u64)
}

/// `number * scale * refinement`, which is an integer by the choice of `refinement`.
fn lattice(number: Scaled, scale: u64, refinement: u64) -> Option<i64> {
    let power = 10i128.checked_pow(number.exponent.unsigned_abs().into())?;
    let scaled = i128::from(number.mantissa).checked_mul(scale.into())?.checked_mul(refinement.into());
    if number.exponent >= 0 {
        return narrow(scaled?.checked_mul(power)?);
    }
    match scaled {
        Some(scaled) => narrow(scaled / power),
        // |mantissa * scale| < 2^121, and the factor may exceed what is left: divide by parts first.
        None => {
            let product = i128::from(number.mantissa) * i128::from(scale);
            let common = greatest_common_divisor(product.unsigned_abs(), power.unsigned_abs()) as i128;
            (product / common).checked_mul(i128::from(refinement) / (power / common)).and_then(narrow)
        }
    }
}

/// Sorts triangles by base triangle, keeping the file's order within each, and finds where each base begins.
fn by_base(triangles: Vec<[u32; 3]>, base_of: Vec<u32>, bases: usize) -> (Vec<[u32; 3]>, Vec<u32>) {
    let mut first = vec![0u32; bases + 1];
    for base in &base_of {
        first[*base as usize + 1] += 1;
    }
    for base in 0..bases {
        first[base + 1] += first[base];
    }
    if base_of.is_sorted() {
        return (triangles, first);
    }
    let (mut next, mut sorted) = (first.clone(), vec![[0; 3]; triangles.len()]);
    for (triangle, base) in triangles.into_iter().zip(base_of) {
        let place = &mut next[base as usize];
        sorted[*place as usize] = triangle;
        *place += 1;
    }
    (sorted, first)
}

/// Consecutive triangles of one group.
pub(super) struct Run {
    /// The first triangle of the run.
    pub(super) first: usize,
    /// The base triangle that the group's name stands for.
    pub(super) base: Option<u32>,
    /// Where the file says so.
    pub(super) place: Place,
}

/// Vertices and faces as OBJ and PLY give them.
pub(super) struct Indexed {
    pub(super) radix: Radix,
    pub(super) vertices: Vec<[Scaled; 3]>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) runs: Vec<Run>,
}

impl Indexed {
    pub(super) fn new(radix: Radix) -> Indexed {
        Indexed { radix, vertices: Vec::new(), triangles: Vec::new(), runs: Vec::new() }
    }

    /// Whether one more vertex and a fan of `corners` corners still can be numbered.
    pub(super) fn has_room(&self, corners: usize) -> Result<(), String> {
        if self.vertices.len() >= u32::MAX as usize - 1 || self.triangles.len() + corners >= MOST_TRIANGLES {
            return Err("is one vertex or triangle too many; 2^32 vertices and 2^32 / 3 triangles are the limit".into());
        }
        Ok(())
    }
}

/// Joins a mesh with its base triangles, if it has any.
pub(super) fn assemble(
    mesh: Indexed,
    mesh_name: &str,
    base: Option<Indexed>,
    base_name: &str,
    progress: &dyn Progress,
) -> Result<Mesh, InputError> {
    if mesh.triangles.is_empty() {
        return Err(InputError::new(mesh_name, Place::File, "holds no face; there is nothing to check"));
    }
    let Indexed { radix, vertices: mut values, mut triangles, runs } = mesh;
    let mut bases = None;
    if let Some(base) = base {
        let offset = values.len();
        if base.triangles.is_empty() {
            return Err(InputError::new(base_name, Place::File, "holds no face; base triangles are expected"));
        }
        if offset + base.vertices.len() >= u32::MAX as usize {
            return Err(InputError::new(base_name, Place::File, "has too many vertices together with the mesh"));
        }
        for (index, vertex) in base.vertices.iter().enumerate() {
            let mut converted = [Scaled::default(); 3];
            for (number, given) in converted.iter_mut().zip(vertex) {
                *number = given.convert(base.radix, radix).ok_or_else(|| {
                    let (kind, shown) =
                        if radix == Radix::Two { ("binary", "floats") } else { ("decimal", "decimals") };
                    let message = format!(
                        "coordinate {} of vertex {index} (counted from 0) has no short {kind} value, and {mesh_name} \
                         holds {kind} {shown}; give both files in the same kind of numbers",
                        given.display(base.radix)
                    );
                    InputError::new(base_name, Place::File, message)
                })?;
            }
            values.push(converted);
        }
        let corners: Vec<[u32; 3]> =
            base.triangles.iter().map(|triangle| triangle.map(|vertex| vertex + offset as u32)).collect();
        let base_of = bases_of_runs(&runs, triangles.len(), corners.len(), mesh_name, base_name)?;
        let first;
        (triangles, first) = by_base(triangles, base_of, corners.len());
        bases = Some(Bases { names: (0..corners.len() as u32).collect(), corners, first });
    }
    // A file may give one point several times, so vertices are identified by coordinates here as well.
    progress.phase("identifying vertices", values.len() as u64);
    let mut vertices = Interner::new();
    // There are no more distinct vertices than vertices, whose number fits.
    let number: Vec<u32> = values.into_iter().map(|value| vertices.intern(value).unwrap_or(0)).collect();
    let renumber = |list: &mut [[u32; 3]]| {
        for triangle in list {
            *triangle = triangle.map(|vertex| number[vertex as usize]);
        }
    };
    renumber(&mut triangles);
    if let Some(bases) = &mut bases {
        renumber(&mut bases.corners);
    }
    Ok(Mesh { points: Points::from_scaled(vertices.keys, radix), triangles, bases })
}

/// The base triangle of each triangle, from the groups.
fn bases_of_runs(
    runs: &[Run],
    triangles: usize,
    bases: usize,
    mesh_name: &str,
    base_name: &str,
) -> Result<Vec<u32>, InputError> {
    let mut base_of = Vec::with_capacity(triangles);
    for (index, run) in runs.iter().enumerate() {
        let end = runs.get(index + 1).map_or(triangles, |next| next.first);
        let base = match run.base {
            Some(base) if (base as usize) < bases => base,
            Some(base) => {
                let message = format!("group base_{base} names no face of {base_name}, which has {bases}, from 0 on");
                return Err(InputError::new(mesh_name, run.place, message));
            }
            None if bases == 1 || end == run.first => 0,
            None => {
                let message = format!(
                    "this face is in no group `base_<I>` and has no property `base`, and {base_name} has {bases} \
                     faces; each face has to say whose it is"
                );
                return Err(InputError::new(mesh_name, run.place, message));
            }
        };
        base_of.resize(base_of.len() + (end - run.first), base);
    }
    Ok(base_of)
}
