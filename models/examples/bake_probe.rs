use relief_models::bake::*;
use relief_models::bisector::*;
use std::time::Instant;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let (map, _) = relief_models::map::read(args[1].as_ref(), 1 << 25).unwrap();
    let b: f64 = args[2].parse().unwrap();
    let tolerance = Tolerance::new((b * 10.0).round() as u32, 10).unwrap();
    for mirrored in [false] {
        let lattice = Lattice::of(map.width as u32, map.height as u32, mirrored).unwrap();
        let ground = Ground { lattice, samples: &map.samples };
        let t = Instant::now();
        let split = unfitted(&ground, tolerance);
        let dt = t.elapsed();
        let c = golden(&lattice, &split, &mut |_| ());
        println!("unfitted mirrored {mirrored} {} in {:?}", c.triangles, dt);
        let n = |i: usize, d: u32| args.get(i).map_or(d, |t| t.parse().unwrap());
        let f = fitted(&ground, tolerance, n(3, 8), &());
        let mut worst = Excess::NONE;
        let mut wait = lattice.roots().to_vec();
        while let Some(node) = wait.pop() {
            if lattice.is_dead(node) {
                continue;
            }
            if node.midpoint().is_some_and(|m| f.split.get(lattice.index(m))) {
                wait.extend(node.halves());
                continue;
            }
            worst = worst.max(ground.excess(node, |i| f.heights[i] as i32));
        }
        println!(
            "fitted {} in {:?} worst {}",
            golden(&lattice, &f.split, &mut |_| ()).triangles,
            t.elapsed(),
            worst.to_f64()
        );
    }
}
