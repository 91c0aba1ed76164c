// SPDX-License-Identifier: MIT OR Apache-2.0
//! What a scene's objects are as draws.

use super::{Object, Scene};
use crate::draw::{CameraView, Draw, DrawError, DrawVertex, MapInfo};
use crate::light::Material;
use crate::map;
use crate::mip_build::{BuildSize, Centring, Extremum, MipError, Pyramid, Wrap, golden, golden_with_poles};
use crate::remesher::Format;

impl Scene {
    /// The camera for the host.
    pub fn view(&self) -> CameraView {
        let camera = &self.camera;
        CameraView {
            eye: camera.eye,
            target: camera.target,
            up: camera.up,
            fov_y: camera.fov_y_deg.to_radians(),
            near: camera.near,
            far: camera.far,
            viewport: camera.viewport,
            cell_px: self.remesh.cell_px,
        }
    }

    /// The draw of an object: constants and vertex memory, as `view` sees it.
    ///
    /// # Errors
    /// It does not fit the formats.
    pub fn draw(&self, object: &Object, view: &CameraView, format: &Format) -> Result<Draw, DrawError> {
        let vertices: Vec<DrawVertex> = object
            .mesh
            .vertices
            .iter()
            .map(|vertex| DrawVertex { position: vertex.position, normal: vertex.normal, uv: vertex.uv })
            .collect();
        let repeat = object.wrap.map(|wrap| wrap == Wrap::Repeat);
        let BuildSize { width, height, levels, .. } = self.levels(object);
        let map = MapInfo { width, height, repeat, levels };
        let mut draw = Draw::new(view, &vertices, &object.mesh.triangles, &map, object.displacement, format)?;
        draw.cull = self.remesh.cull;
        draw.rules = self.remesh.rules;
        if let Some(colour) = object.colour {
            draw.material = Material::plain(colour);
        }
        Ok(draw)
    }

    /// What the builder of an object's levels is told.
    pub fn levels(&self, object: &Object) -> BuildSize {
        let (width, height, wrap) = (object.map.width, object.map.height, object.wrap);
        let levels = map::levels([width, height], wrap).len().min(self.remesh.levels);
        BuildSize { width, height, wrap, centring: Centring::Node, levels, poles: object.poles }
    }

    /// An object's levels, as the golden builder makes them: the greatest of each node's neighbours.
    ///
    /// # Errors
    /// The map has no levels; a scene's reader lets none through.
    pub fn pyramid(&self, object: &Object) -> Result<Pyramid, MipError> {
        self.pyramid_of(object, Extremum::Max)
    }

    /// An object's levels, the greatest and the least, for [rules](crate::rules) that read minima.
    ///
    /// # Errors
    /// As of [`pyramid`](Self::pyramid).
    pub fn pyramids(&self, object: &Object) -> Result<[Pyramid; 2], MipError> {
        Ok([self.pyramid(object)?, self.pyramid_of(object, Extremum::Min)?])
    }

    fn pyramid_of(&self, object: &Object, extremum: Extremum) -> Result<Pyramid, MipError> {
        let BuildSize { width, height, wrap, centring, levels, poles } = self.levels(object);
        let build = if poles { golden_with_poles } else { golden };
        build(width, height, &object.map.samples, centring, wrap, extremum, levels)
    }
}

impl Object {
    /// Whether its map meets itself somewhere.
    pub fn has_seam(&self) -> bool {
        self.poles || self.wrap.contains(&Wrap::Repeat)
    }
}
