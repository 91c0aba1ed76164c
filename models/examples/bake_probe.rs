use relief_models::bake::*;
use relief_models::bisector::*;
use std::time::Instant;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let (map, _) = relief_models::map::read(args[1].as_ref(), 1 << 25).unwrap();
    let b: f64 = args[2].parse().unwrap();
    let tolerance = Tolerance { over: (b * 10.0).round() as u32, under: 10 };
    for mirrored in [false, true] {
        let lattice = Lattice::of(map.width as u32, map.height as u32, mirrored).unwrap();
        let ground = Ground { lattice, samples: &map.samples };
        let t = Instant::now();
        let split = unfitted(&ground, tolerance);
        let dt = t.elapsed();
        let c = golden(&lattice, &split, &mut |_| ());
        println!("unfitted mirrored {mirrored} {} in {:?}", c.triangles, dt);
    }
}
