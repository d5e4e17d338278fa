//! The curve that reflectances are made of.

/// The range of the curve, nm; outside it the reflectance is constant.
pub(crate) const CURVE_NM: [f64; 2] = [380.0, 780.0];

/// The coefficients a, b, c of a curve, a sigmoid of a quadratic: S(x) = 1/2 + x/(2√(1 + x²)) with
/// x = a + b t + c (3t² − 1)/2, and t from −1 at 380 nm to 1 at 780 nm.  Eq. (P20)
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Coefficients(pub [f64; 3]);

impl Coefficients {
    pub fn at(&self, wavelength_nm: f64) -> f64 {
        let [_, t, quadratic] = Self::basis(wavelength_nm);
        let [a, b, c] = self.0;
        let x = a + b * t + c * quadratic;
        0.5 + 0.5 * x / (1.0 + x * x).sqrt()
    }

    /// The Legendre polynomials P₀, P₁, P₂ at t. They are orthogonal, so the equations for the
    /// coefficients are better conditioned than with powers of t.
    pub fn basis(wavelength_nm: f64) -> [f64; 3] {
        let t = (wavelength_nm - 580.0) / 200.0;
        [1.0, t, 1.5 * t * t - 0.5]
    }
}
