//! Ambient light (a uniform sky) on a surface that moves relative to it.

use core::f64::consts::PI;

use glam::DVec3;

use crate::Velocity;

/// Nodes and weights of eight-point Gauss–Legendre quadrature on −1…1 (Abramowitz and Stegun, table
/// 25.4).
const NODES: [(f64, f64); 8] = [
    (-0.960_289_856_497_536_3, 0.101_228_536_290_376_3),
    (-0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
    (-0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (-0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_3),
];

/// A ring of the sky round a surface, on which the Doppler factor is constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyRing {
    /// The ring's contribution to the light level, before any power of `doppler` is applied.
    pub level: f64,
    /// Its Doppler factor D_l = f_surface/f_sky.
    pub doppler: f64,
}

/// The light on a surface with unit normal `normal` from a sky that is uniformly bright in its own
/// frame, where it gives level 1. `v_sky` is the velocity of the sky's frame in the frame of the
/// surface.  Eq. (P14)
///
/// With μ'' the cosine between v_sky and the direction to a point of the sky, in the sky's frame,
/// D_l = γ(1 − βμ''), so D_l is constant on a ring. In the surface's frame the ring is at μ' = (μ''
/// − β)/(1 − βμ''), and the mean of max(0, n·l) over it has a closed form. The remaining integral,
/// 2∫ ⟨max(0, n·l)⟩ dμ'', is evaluated with eight rings over the range of μ'' where rings lie
/// wholly above the horizon, and eight over the range where the horizon cuts them. Rings below the
/// horizon are omitted. At rest the levels add up to 1 within 10⁻³.
///
/// Irradiance is Σ level · D_l², as for any directional light, because `level` counts the ring's
/// solid angle in the sky's frame.
pub fn ambient_illumination(normal: DVec3, v_sky: Velocity) -> impl Iterator<Item = SkyRing> {
    let along = normal.dot(v_sky.direction()).clamp(-1.0, 1.0);
    let across = ((1.0 - along) * (1.0 + along)).sqrt();
    let beta = v_sky.speed();
    // Rings with |μ'| < n_⊥ are cut by the horizon.
    let in_sky = move |cos: f64| (cos + beta) / (1.0 + beta * cos);
    let (low, high) = (in_sky(-across), in_sky(across));
    let whole = if along > 0.0 { (high, 1.0) } else { (-1.0, low) };
    [(low, high), whole].into_iter().flat_map(move |(low, high)| {
        NODES.into_iter().filter_map(move |(node, weight)| {
            let half = 0.5 * (high - low);
            let cos_sky = low + half * (1.0 + node);
            let stretch = 1.0 - beta * cos_sky;
            let cos = ((cos_sky - beta) / stretch).clamp(-1.0, 1.0);
            let level =
                2.0 * half * weight * mean_cosine(along * cos, across * (1.0 - cos * cos).sqrt());
            let doppler = v_sky.gamma() * stretch;
            (level > 0.0 && doppler > 0.0).then_some(SkyRing { level, doppler })
        })
    })
}

/// The mean of max(0, a + b cos φ) over all φ, b ≥ 0.
fn mean_cosine(a: f64, b: f64) -> f64 {
    if a >= b {
        return a;
    }
    if a <= -b {
        return 0.0;
    }
    let rise = libm::acos(-a / b);
    (a * rise + b * libm::sin(rise)) / PI
}
