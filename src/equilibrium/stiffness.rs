//! The stiffness of a scene at a state, and its factors: 6 × 6 blocks at the bodies and at pairs that touch.

use super::answer::Demand;
use super::assembly::{Assembly, Joint};
use super::error::EquilibriumError;
use super::numbers::LEAST_WEIGHT;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::lu::{LuRef, LuSymbolicParams, NumericLu, SymbolicLu, factorize_symbolic_lu};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, Mat, Par};
use nalgebra::Matrix6;
use std::collections::BTreeMap;

/// The matrix E K Eᵀ + ε W, and its LU factors. It is not symmetric where joints slip.
pub(super) struct Stiffness {
    pattern: SymbolicSparseColMat<usize>,
    values: Vec<f64>,
    /// Of each joint and pair of its ends: where the block's columns begin.
    blocks: Vec<[Option<[usize; 6]>; 4]>,
    diagonal: Vec<usize>,
    symbolic: SymbolicLu<usize>,
    factors: NumericLu<usize, f64>,
    memory: MemBuffer,
    /// Number of factorisations so far.
    pub solves: u32,
}

impl Stiffness {
    pub fn new(assembly: &Assembly) -> Result<Self, EquilibriumError> {
        let count = assembly.dead.len() / 6;
        let mut neighbours: Vec<BTreeMap<usize, usize>> = (0..count).map(|i| BTreeMap::from([(i, 0)])).collect();
        for joint in &assembly.joints {
            if let [Some(first), Some(second)] = joint.ends {
                neighbours[first].insert(second, 0);
                neighbours[second].insert(first, 0);
            }
        }
        let (mut columns, mut rows, mut diagonal) = (vec![0], Vec::new(), Vec::new());
        for (body, of) in neighbours.iter_mut().enumerate() {
            let height = 6 * of.len();
            for (place, (other, begin)) in of.iter_mut().enumerate() {
                *begin = rows.len() + 6 * place;
                if *other == body {
                    diagonal.extend((0..6).map(|i| *begin + i * height + i));
                }
            }
            for _ in 0..6 {
                rows.extend(of.keys().flat_map(|other| 6 * other..6 * other + 6));
                columns.push(rows.len());
            }
        }
        let block = |row: Option<usize>, column: Option<usize>| {
            let (of, row) = (&neighbours[column?], row?);
            Some([0, 1, 2, 3, 4, 5].map(|i| of[&row] + i * 6 * of.len()))
        };
        let blocks = assembly.joints.iter().map(|Joint { ends: [a, b], .. }| {
            [(a, a), (a, b), (b, a), (b, b)].map(|(row, column)| block(*row, *column))
        });
        let blocks = blocks.collect();
        let failed = |_| EquilibriumError::NotConverged { status: "too little memory for the stiffness".into() };
        let values = vec![0.0; rows.len()];
        let pattern = SymbolicSparseColMat::new_checked(6 * count, 6 * count, columns, None, rows);
        // Blocks of six are supernodes, whatever the count of operations says.
        let params = LuSymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..LuSymbolicParams::default()
        };
        let symbolic = factorize_symbolic_lu(pattern.as_ref(), params).map_err(failed)?;
        let scratch = symbolic.factorize_numeric_lu_scratch::<f64>(Par::Seq, Default::default());
        let memory = MemBuffer::new(scratch.or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq)));
        Ok(Self { pattern, values, blocks, diagonal, symbolic, factors: NumericLu::new(), memory, solves: 0 })
    }

    /// Factorises at displacements v, with drag × weights on the diagonal. False if a pivot is 0.
    pub fn factorise(&mut self, assembly: &Assembly, v: &[f64], at: Demand, drag: f64, weights: &[f64]) -> bool {
        self.values.fill(0.0);
        for (joint, columns) in assembly.joints.iter().zip(&self.blocks) {
            let mut sums = [Matrix6::zeros(); 4];
            for point in &assembly.points[joint.points.clone()] {
                let stiffness = point.strength.tangent(&joint.slip(point, v), at.strength);
                let [first, second] = [0, 1].map(|end| joint.moves(point, end));
                for (end, of) in [first, second].into_iter().enumerate().filter(|(end, _)| joint.ends[*end].is_some()) {
                    let forces = of * stiffness;
                    sums[2 * end] += forces * first.transpose();
                    sums[2 * end + 1] += forces * second.transpose();
                }
            }
            for (begin, sum) in columns.iter().zip(&sums).filter_map(|(begin, sum)| Some((begin.as_ref()?, sum))) {
                for (column, begin) in begin.iter().enumerate() {
                    (0..6).for_each(|row| self.values[begin + row] += sum[(row, column)]);
                }
            }
        }
        self.diagonal.iter().zip(weights).for_each(|(place, weight)| self.values[*place] += drag * weight);
        self.solves += 1;
        let matrix = SparseColMatRef::new(self.pattern.as_ref(), &self.values);
        let stack = MemStack::new(&mut self.memory);
        self.symbolic.factorize_numeric_lu(&mut self.factors, matrix, Par::Seq, stack, Default::default()).is_ok()
    }

    /// The displacements of a load, by the factors.
    pub fn solve(&mut self, load: &[f64]) -> Vec<f64> {
        let mut column = Mat::from_fn(load.len(), 1, |i, _| load[i]);
        let stack = MemStack::new(&mut self.memory);
        LuRef::new_unchecked(&self.symbolic, &self.factors).solve_in_place_with_conj(
            Conj::No,
            column.as_mut(),
            Par::Seq,
            stack,
        );
        (0..load.len()).map(|i| column[(i, 0)]).collect()
    }
}

/// The stiffness of all points against each coordinate alone, as if all stuck: what drag is measured in.
pub(super) fn weights(assembly: &Assembly) -> Vec<f64> {
    let mut found = vec![0.0; assembly.dead.len()];
    for (joint, point) in assembly.each_point() {
        for (body, _, end) in joint.bodies() {
            let moves = joint.moves(point, end);
            (0..6).for_each(|i| found[6 * body + i] += point.strength.stiffness[0] * moves.row(i).norm_squared());
        }
    }
    // A body that touches at one point, or on a line through its centre, turns without resistance.
    for six in found.chunks_mut(6) {
        let least = LEAST_WEIGHT * six.iter().copied().fold(0.0, f64::max);
        six.iter_mut().for_each(|weight| *weight = weight.max(least));
    }
    found
}
