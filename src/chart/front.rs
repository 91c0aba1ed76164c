// SPDX-License-Identifier: MIT OR Apache-2.0
//! The Pareto front: what no other point beats in one figure without losing in the other.

/// Whether each point is on the front. Absent points are not, and equal ones all are.
pub fn front(places: &[Option<[f64; 2]>]) -> Vec<bool> {
    let mut order: Vec<usize> = (0..places.len()).filter(|&at| places[at].is_some()).collect();
    let place = |at: usize| places[at].unwrap_or([f64::INFINITY; 2]);
    order.sort_by(|&a, &b| {
        let ([x, y], [u, v]) = (place(a), place(b));
        x.total_cmp(&u).then(y.total_cmp(&v))
    });
    let mut is_best = vec![false; places.len()];
    // From the cheapest on, each has to be better than all before it, or be the same as the last that was.
    let mut last: Option<[f64; 2]> = None;
    for at in order {
        let here = place(at);
        if last.is_none_or(|last| here[1] < last[1] || here == last) {
            is_best[at] = true;
            last = Some(here);
        }
    }
    is_best
}

#[cfg(test)]
mod tests {
    use super::front;

    /// Against the definition, on all sets of four places of a 3 x 3 board and an absent one.
    #[test]
    fn front_is_what_nothing_dominates() {
        let board: Vec<_> = (0..9).map(|at| Some([f64::from(at % 3), f64::from(at / 3)])).chain([None]).collect();
        let mut counts = [0; 2];
        for code in 0..10_000 {
            let places: Vec<_> = [1, 10, 100, 1000].iter().map(|digit| board[code / digit % 10]).collect();
            for (place, is_best) in places.iter().zip(front(&places)) {
                let beaten =
                    |[x, y]: [f64; 2]| places.iter().flatten().any(|&[u, v]| u <= x && v <= y && (u < x || v < y));
                assert_eq!(is_best, place.is_some_and(|place| !beaten(place)), "{places:?}");
                counts[usize::from(is_best)] += 1;
            }
        }
        assert!(counts.iter().all(|count| *count > 1_000), "{counts:?}");
    }
}
