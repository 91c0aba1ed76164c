// SPDX-License-Identifier: MIT OR Apache-2.0
//! The page: what to take, why, the drawings, and every point. It holds its drawings and asks for nothing else.

use std::collections::BTreeSet;
use std::error::Error;

use relief_testbench::method::METHODS;

use super::advice::{self, count, figure};
use super::draw::Errors;
use super::{Chapter, Figure, picture};

mod tables;

use tables::{all_points, comparison, filters};

const STYLE: &str = include_str!("page/page.css");

/// The whole page. `absence` tells of peers that were not there at all.
///
/// # Errors
/// A drawing fails.
pub fn page(chapters: &[Chapter], absence: &[String]) -> Result<String, Box<dyn Error>> {
    let mut body = String::from("<h1>Relief: from height maps to triangles</h1>\n");
    body += &paragraph(
        "Each method made meshes of the maps below, from coarse to fine, and every mesh was measured at every sample of its \
         map. An error is a difference of height. What to take is told first, map by map; the drawings and the table of all \
         meshes are behind it.",
    );
    let links = chapters.iter().map(|chapter| {
        let subject = &chapter.subject;
        let line = escaped(&advice::headline(chapter));
        format!("<li><a href=\"#{}\">{}</a>: {line}</li>\n", subject.slug, escaped(&subject.name))
    });
    body += &format!("<ul>\n{}</ul>\n", links.collect::<String>());
    for chapter in chapters {
        body += &section(chapter, absence)?;
    }
    body += &reading(chapters, absence);
    let title = chapters.iter().map(|chapter| escaped(&chapter.subject.name)).collect::<Vec<_>>().join(", ");
    let view = "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">";
    let head =
        format!("<meta charset=\"utf-8\">\n{view}\n<title>Relief chart: {title}</title>\n<style>\n{STYLE}</style>");
    Ok(format!("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n{head}\n</head>\n<body>\n{body}</body>\n</html>\n"))
}

/// Text as it may stand in a page.
fn escaped(text: &str) -> String {
    let letters = text.chars().map(|letter| match letter {
        '&' => "&amp;".into(),
        '<' => "&lt;".into(),
        '>' => "&gt;".into(),
        '"' => "&quot;".into(),
        '\'' => "&#39;".into(),
        letter => letter.to_string(),
    });
    letters.collect()
}

fn paragraph(text: &str) -> String {
    format!("<p>{}</p>\n", escaped(text))
}

fn list(sentences: impl Iterator<Item = String>) -> String {
    let items: String = sentences.map(|sentence| format!("<li>{}</li>\n", escaped(&sentence))).collect();
    if items.is_empty() { items } else { format!("<ul>\n{items}</ul>\n") }
}

fn section(chapter: &Chapter, absence: &[String]) -> Result<String, Box<dyn Error>> {
    let subject = &chapter.subject;
    let [low, high] = subject.bounds();
    let (kind, measured) = advice::kind(subject);
    let world =
        subject.world.map_or_else(String::new, |scale| format!(" A map unit is {} in the scene.", figure(scale)));
    let mut text = format!("<section>\n<h2 id=\"{}\">{}: {kind}</h2>\n", subject.slug, escaped(&subject.name));
    let size = format!("{} x {} samples", count(subject.map.width as u64), count(subject.map.height as u64));
    text += &paragraph(&format!("{size} from {low} to {high}, of {} bits.{world} {measured}", subject.bits));
    let sentences = advice::sentences(chapter);
    text += "<div class=\"take\">\n<h3>What to take</h3>\n";
    for (heading, sentences) in sentences {
        text += &format!("<h4>{}</h4>\n{}", escaped(&heading), list(sentences.into_iter()));
    }
    text += "</div>\n";
    for choice in advice::choices(chapter) {
        text += &comparison(subject, &choice);
    }
    text += "<h3>Drawings</h3>\n";
    text += &paragraph("Lower is better, and so is farther left. Both axes are logarithmic.");
    text += "<div class=\"figures\">\n";
    for at in Figure::ALL {
        let name = format!("{}-{}", subject.slug, at.name());
        let files = format!("<a href=\"{name}.svg\">SVG</a>, <a href=\"{name}.png\">PNG</a>");
        let caption = format!("<figcaption>{} ({files})</figcaption>", at.title());
        text += &format!("<figure>\n{}\n{caption}\n</figure>\n", picture::svg(&Errors(chapter, at))?);
    }
    text += "</div>\n";
    text += &horizons(chapter)?;
    text += &format!(
        "<details>\n<summary>All {} meshes of {}</summary>\n{}</details>\n",
        chapter.points.len(),
        escaped(&subject.name),
        all_points(chapter)
    );
    if !chapter.failures.is_empty() {
        text += "<h3>What is wrong</h3>\n";
        text += &list(chapter.failures.iter().cloned());
    }
    if !chapter.notes.is_empty() || !absence.is_empty() {
        text += "<h3>What did not run</h3>\n";
        text += &list(chapter.notes.iter().chain(absence).cloned());
    }
    Ok(text + "</section>\n")
}

/// What filters do to the horizon.
fn horizons(chapter: &Chapter) -> Result<String, Box<dyn Error>> {
    if chapter.silhouettes.is_empty() {
        return Ok(String::new());
    }
    let mut text = String::from("<h3>What filters keep of the horizon</h3>\n");
    text += &paragraph(
        "Vertices stand some texels apart, their step, and take their heights from a level of each filter. Errors are those of the \
         horizon seen from two sides, over all places of the grid, as shares of the range; a peak loss is how far the highest \
         point sinks, and deepest the most that any column loses. Filters of minima are judged from below. Those that keep peaks \
         are for maps seen from afar; means are for shading.",
    );
    text += &filters(chapter);
    text += "<div class=\"figures\">\n";
    for silhouettes in &chapter.silhouettes {
        let name = format!("{}-{}", chapter.subject.slug, silhouettes.file());
        let files = format!("<a href=\"{name}.svg\">SVG</a>, <a href=\"{name}.png\">PNG</a>");
        let caption = format!("<figcaption>Horizon of a grid of {} texels ({files})</figcaption>", silhouettes.step);
        text += &format!("<figure>\n{}\n{caption}\n</figure>\n", picture::svg(silhouettes)?);
    }
    Ok(text + "</div>\n")
}

/// How to read it, and what ran.
fn reading(chapters: &[Chapter], absence: &[String]) -> String {
    let mut text = String::from("<h2>How to read this</h2>\n");
    let sentences = [
        "Percentages are shares of the range of the map, from its lowest to its highest sample. A max is over all samples and \
         all triangles there, and RMS is the root of the mean squared error.",
        "A claim is the greatest error that a method promises. Holds: every sample is within it. No claim: the method promises \
         nothing, and what it does on one map tells little of another. BROKEN: some sample is beyond it, or the mesh has gaps.",
        "Cycles come from the counter of the block itself, from the first beat of a draw to its last triangle; the map is loaded \
         before. Reads are words of its map memories, and memory bits what the map takes there.",
        "Preparation turns the map into what the memories hold, once a map. Golden is the model in software from there to \
         triangles; for a peer, all of its work. Both are single runs on one machine. All other columns, but for the peers, are \
         the same on every machine.",
        "On the front: no other whole mesh is better in one of the two figures of a drawing and as good in the other.",
        "Each method ran at its own goals, and at 1 % and 2 % of the range. Methods that promise nothing look for the coarsest of \
         their grids, in powers of two, that is found within such a bound.",
    ];
    text += &list(sentences.iter().map(|sentence| (*sentence).to_owned()));
    text += "<h3>What ran</h3>\n";
    let ran: BTreeSet<(&str, &str)> =
        chapters.iter().flat_map(|chapter| &chapter.points).map(|point| (&*point.method, &*point.version)).collect();
    let version = |name: &str| ran.iter().find(|(known, _)| *known == name).map(|(_, version)| *version);
    let ours = METHODS.iter().map(|method| match version(method.name()) {
        Some(version) => format!("{} (Relief {version}): {}", method.name(), method.summary()),
        None => format!("{}: did not run", method.name()),
    });
    let peers = super::peers::NAMES.iter().map(|name| match version(name) {
        Some(version) => format!("{name} {version} (peer): {}", super::peers::summary(name)),
        None => format!("{name} (peer): did not run"),
    });
    text += &list(ours.chain(peers).chain(absence.iter().cloned()));
    text += "<p>The same points as comma-separated values: <a href=\"points.csv\">points.csv</a>; the horizons under filters: \
             <a href=\"filters.csv\">filters.csv</a>.</p>\n";
    text
}
