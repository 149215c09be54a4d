//! Distributions of size.

use super::numbers::ADD_UP;
use crate::packing::error::PackError;

/// How large the bodies are, by number. The size of a body is the diameter of a ball of its volume.
///
/// ```
/// use potential_particles::packing::Sizes;
/// // Three in ten bodies of size 2, the others of size 1.
/// Sizes::by_number(&[[1.0, 0.7], [2.0, 0.3]])?;
/// // A grading curve: by mass nothing is below 1, four tenths below 2, everything below 4.
/// Sizes::passing(&[[1.0, 0.0], [2.0, 0.4], [4.0, 1.0]])?;
/// assert!(Sizes::by_mass(&[[1.0, 0.5], [2.0, 0.4]]).unwrap_err().to_string().contains("add up to 0.9"));
/// # Ok::<(), potential_particles::packing::PackError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sizes {
    /// In the order given; empty: shapes as they are.
    classes: Vec<Class>,
}

/// Sizes between two, of which the same mass lies in any two intervals of the same length.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Class {
    from: f64,
    to: f64,
    /// Share by number of this class and all before it.
    up_to: f64,
}

impl Sizes {
    /// Every shape in the size that it has.
    pub fn as_given() -> Self {
        Self::default()
    }

    /// From rows of a size and its share of the number of bodies.
    ///
    /// # Errors
    /// No rows, a size that is not positive and finite, a share outside [0, 1], shares that do not add up to 1.
    pub fn by_number(rows: &[[f64; 2]]) -> Result<Self, PackError> {
        check(rows)?;
        check_sum(rows)?;
        Ok(Self::of(rows.iter().map(|&[size, share]| (size, size, share))))
    }

    /// From rows of a size and its share of the mass: of bodies of one density there are share/size³.
    ///
    /// # Errors
    /// As of [`Sizes::by_number`].
    pub fn by_mass(rows: &[[f64; 2]]) -> Result<Self, PackError> {
        check(rows)?;
        check_sum(rows)?;
        let largest = largest(rows);
        Ok(Self::of(rows.iter().map(|&[size, share]| (size, size, share * (largest / size).powi(3)))))
    }

    /// From a grading curve: rows of a size and the share of the mass in bodies below it, linear in between.
    ///
    /// Between the sizes a and b the mass is spread evenly over size, so that by number the density is as size⁻³, and a
    /// share m of the mass is m/(b−a) ∫ size⁻³ = m (a+b)/(2 a² b²) of the number, but for a factor.
    ///
    /// # Errors
    /// Rows whose sizes do not grow, or that do not grow from 0 to 1.
    pub fn passing(rows: &[[f64; 2]]) -> Result<Self, PackError> {
        check(rows)?;
        let grows = |i: &usize| *i > 0 && rows[i - 1][0] < rows[*i][0] && rows[i - 1][1] <= rows[*i][1];
        let fault = (1..rows.len()).find(|i| !grows(i));
        let last = rows.len() - 1;
        let fault = fault.or((rows[0][1] != 0.0).then_some(0)).or((rows[last][1] != 1.0).then_some(last));
        if let Some(index) = fault {
            return Err(PackError::GradingCurve { index });
        }
        let largest = largest(rows);
        Ok(Self::of(rows.windows(2).map(|pair| {
            let ([a, below_a], [b, below_b]) = (pair[0], pair[1]);
            let (p, q) = (largest / a, largest / b);
            (a, b, (below_b - below_a) * p * q * (p + q))
        })))
    }

    /// From classes (smallest size, largest size, weight by number).
    fn of(classes: impl Iterator<Item = (f64, f64, f64)> + Clone) -> Self {
        let total: f64 = classes.clone().map(|(.., weight)| weight).sum();
        let mut sum = 0.0;
        let running = classes.filter(|(.., weight)| *weight > 0.0).map(|(from, to, weight)| {
            sum += weight;
            Class { from, to, up_to: sum / total }
        });
        Self { classes: running.collect() }
    }

    /// The size below which lies the share u of all bodies, classes taken in the order given; `None`: as given.
    pub(crate) fn at(&self, u: f64) -> Option<f64> {
        let last = self.classes.len().checked_sub(1)?;
        let i = self.classes.iter().position(|class| u < class.up_to).unwrap_or(last);
        let Class { from, to, up_to } = self.classes[i];
        let before = if i == 0 { 0.0 } else { self.classes[i - 1].up_to };
        let within = ((u - before) / (up_to - before)).clamp(0.0, 1.0);
        // 1/size² falls linearly: the integral of size⁻³.
        let ratio = from / to;
        Some(from / (1.0 - within * (1.0 - ratio * ratio)).sqrt())
    }

    /// The smallest and the largest size; `None`: as given.
    pub(crate) fn range(&self) -> Option<(f64, f64)> {
        let smallest = self.classes.iter().map(|class| class.from).reduce(f64::min)?;
        Some((smallest, self.classes.iter().map(|class| class.to).reduce(f64::max)?))
    }
}

fn largest(rows: &[[f64; 2]]) -> f64 {
    rows.iter().map(|[size, _]| *size).fold(0.0, f64::max)
}

fn check(rows: &[[f64; 2]]) -> Result<(), PackError> {
    if rows.is_empty() {
        return Err(PackError::NoSizes);
    }
    for (index, &[size, share]) in rows.iter().enumerate() {
        if !(size > 0.0 && size.is_finite()) {
            return Err(PackError::Size { index, size });
        }
        if !(0.0..=1.0).contains(&share) {
            return Err(PackError::Share { index, share });
        }
    }
    Ok(())
}

fn check_sum(rows: &[[f64; 2]]) -> Result<(), PackError> {
    let sum: f64 = rows.iter().map(|[_, share]| share).sum();
    if (sum - 1.0).abs() <= ADD_UP { Ok(()) } else { Err(PackError::SharesDoNotAddUp(sum)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of evenly spread u, the mass below each size, against the curve.
    #[test]
    fn a_grading_curve_is_met_by_mass() {
        let rows = [[1.0, 0.0], [2.0, 0.4], [2.5, 0.4], [8.0, 1.0]];
        let sizes = Sizes::passing(&rows).unwrap();
        let count = 200_000;
        let all: Vec<f64> = (0..count).map(|i| sizes.at((f64::from(i) + 0.5) / f64::from(count)).unwrap()).collect();
        let total: f64 = all.iter().map(|size| size.powi(3)).sum();
        for (size, passing) in [(1.5, 0.2), (2.0, 0.4), (2.3, 0.4), (5.25, 0.7), (8.0, 1.0)] {
            let below: f64 = all.iter().filter(|&&s| s <= size).map(|s| s.powi(3)).sum();
            assert!((below / total - passing).abs() < 1e-3, "{size}: {}", below / total);
        }
    }

    #[test]
    fn classes_have_their_shares() {
        let by_number = Sizes::by_number(&[[3.0, 0.25], [1.0, 0.75]]).unwrap();
        assert_eq!([0.0, 0.24, 0.26, 1.0].map(|u| by_number.at(u).unwrap()), [3.0, 3.0, 1.0, 1.0]);
        // Half the mass in bodies of 27 times the mass: one in 28.
        let by_mass = Sizes::by_mass(&[[3.0, 0.5], [1.0, 0.5]]).unwrap();
        assert_eq!([0.999 / 28.0, 1.001 / 28.0].map(|u| by_mass.at(u).unwrap()), [3.0, 1.0]);
        assert_eq!(by_mass.range(), Some((1.0, 3.0)));
        assert_eq!(Sizes::as_given().at(0.5), None);
    }

    #[test]
    fn what_is_no_distribution_is_refused() {
        let fault = |made: Result<Sizes, PackError>| made.unwrap_err().to_string();
        assert!(fault(Sizes::by_number(&[])).contains("no sizes"));
        assert!(fault(Sizes::by_number(&[[1.0, 0.5], [-2.0, 0.5]])).contains("size -2.0 (entry 1)"));
        assert!(fault(Sizes::by_mass(&[[f64::NAN, 1.0]])).contains("size NaN"));
        assert!(fault(Sizes::by_number(&[[1.0, 1.5]])).contains("share 1.5"));
        assert!(fault(Sizes::by_number(&[[1.0, 0.5]])).contains("add up to 0.5"));
        for rows in [&[[1.0, 0.0]][..], &[[1.0, 0.0], [1.0, 1.0]], &[[1.0, 0.1], [2.0, 1.0]], &[[1.0, 0.0], [2.0, 0.9]]]
        {
            assert!(fault(Sizes::passing(rows)).contains("grading curve"), "{rows:?}");
        }
    }
}
