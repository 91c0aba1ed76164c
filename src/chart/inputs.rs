// SPDX-License-Identifier: MIT OR Apache-2.0
//! Maps and scenes become subjects.

use std::error::Error;
use std::path::{Path, PathBuf};

use relief_models::bisector::MAX_SIDE;
use relief_models::map::read_values;
use relief_models::scene;

use super::Subject;

/// Samples of the map where a scene gives its greatest displacement.
const GREATEST: f64 = 65535.0;

/// The subjects of all files, and warnings to print.
///
/// # Errors
/// A sentence: a file is neither a map nor a scene that can be read.
pub fn read(paths: &[PathBuf]) -> Result<(Vec<Subject>, Vec<String>), Box<dyn Error>> {
    let (mut subjects, mut warnings) = (Vec::new(), Vec::new());
    for path in paths {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let is = |wanted: &str| path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(wanted));
        if is("png") {
            let (map, bits) = read_values(path, MAX_SIDE)?;
            if bits < 16 {
                let most = (1u32 << bits) - 1;
                warnings.push(format!(
                    "{}: has {bits} bits a sample, so heights are 0 to {most} in steps; 16-bit grey is smooth",
                    path.display()
                ));
            }
            subjects.push(Subject { name: stem, slug: String::new(), map, bits, world: None });
        } else if is("toml") {
            scenes(path, &stem, &mut subjects)?;
        } else {
            let expected = "a map (.png, grey) or a scene (.toml) is expected";
            return Err(format!("{}: is neither .png nor .toml; {expected}", path.display()).into());
        }
    }
    let mut slugs: Vec<String> = Vec::new();
    for subject in &mut subjects {
        let plain = slug(&subject.name);
        let mut taken = (2..).map(|number| format!("{plain}-{number}"));
        let mut slug = plain.clone();
        while slugs.contains(&slug) {
            slug = taken.next().unwrap_or_default();
        }
        slugs.push(slug.clone());
        subject.slug = slug;
    }
    Ok((subjects, warnings))
}

/// Each object of a scene. Its map is measured flat, as a height field.
fn scenes(path: &Path, stem: &str, subjects: &mut Vec<Subject>) -> Result<(), Box<dyn Error>> {
    let scene = scene::read(path)?;
    let several = scene.objects.len() > 1;
    for (object, number) in scene.objects.into_iter().zip(1..) {
        let [least, most] = object.displacement;
        if object.map.width < 2 || object.map.height < 2 {
            let size = format!("{} x {}", object.map.width, object.map.height);
            let what = format!("object {number} has a map of {size} samples, which is no surface");
            return Err(format!("{}: {what}; 2 x 2 samples are the least", path.display()).into());
        }
        subjects.push(Subject {
            name: if several { format!("{stem}, object {number}") } else { stem.to_owned() },
            slug: String::new(),
            map: object.map,
            bits: 16,
            world: Some((most - least) / GREATEST).filter(|scale| *scale > 0.0),
        });
    }
    Ok(())
}

/// Letters, digits and single dashes.
fn slug(name: &str) -> String {
    let plain = |letter: char| if letter.is_ascii_alphanumeric() { letter.to_ascii_lowercase() } else { ' ' };
    let words: String = name.chars().map(plain).collect();
    let slug = words.split_whitespace().collect::<Vec<_>>().join("-");
    // Some file systems end names at 255 bytes.
    let short = slug.get(..100).unwrap_or(&slug);
    if short.is_empty() { "map".into() } else { short.into() }
}
