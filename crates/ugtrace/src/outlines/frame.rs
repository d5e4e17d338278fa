//! Rays of the picture in the rest frame of a body, and back.

use glam::{DMat3, DVec3};
use ugphysics::Velocity;
use ugscene::{BodyId, Face, RestFrames, Scene, View};

use super::film::{Form, center};
use super::sections::Side;

/// The rays of a picture in the rest frame of a body, in aligned axes (û, e₁, e₂): the first is the
/// direction of motion, so that a boost changes one coordinate only. All coordinates are relative
/// to the eye.
#[derive(Clone, Debug)]
pub struct PictureRays {
    /// The velocity of the body.
    pub velocity: Velocity,
    /// Rotates rest coordinates to the axes of the scene, in which lights and normals are given.
    /// Eq. (P25)
    pub scene_from_aligned: DMat3,
    /// Displacement of lamps for the body, see [`ugscene::RestFrames::lamp_shift`].
    pub lamp_shift: DVec3,
    /// From apparent coordinates to samples: x and y times the depth, and the depth.
    samples_from_seen: DMat3,
    /// The ray through the corner of the picture, and its change per sample across and down; depth
    /// 1.
    rays: [DVec3; 3],
    exp_minus_rapidity: f64,
}

/// A ray in the rest frame.
#[derive(Clone, Copy, Debug)]
pub struct RestRay {
    /// The emission event of light seen at depth 1, as a position at rest.  Eq. (P4), (P6)
    pub rest: DVec3,
    /// 1/D, the factor by which wavelengths are stretched: |p'|/|p|.  Eq. (P10)
    pub stretch: f64,
}

impl PictureRays {
    /// The rays in the rest frame of each body of a scene.
    pub fn all(frames: &RestFrames, view: &View, scene: &Scene) -> Vec<Self> {
        scene.bodies.ids().map(|body| Self::new(frames, view, body)).collect()
    }

    fn new(frames: &RestFrames, view: &View, body: BodyId) -> Self {
        let velocity = frames.velocity(body);
        let along = velocity.direction();
        let (e1, e2) = along.any_orthonormal_pair();
        let camera_from_aligned = DMat3::from_cols(along, e1, e2);
        let aligned_from_camera = camera_from_aligned.transpose();
        let scene_from_boosted = DMat3::from_quat(frames.of(body).scene_from_boosted());
        let place = |axis: DVec3| {
            let place = view.place(axis);
            DVec3::new(place.x, place.y, place.z)
        };
        Self {
            velocity,
            scene_from_aligned: scene_from_boosted * camera_from_aligned,
            lamp_shift: frames.lamp_shift(body),
            samples_from_seen: DMat3::from_cols(place(along), place(e1), place(e2)),
            rays: view.rays().map(|ray| aligned_from_camera * ray),
            exp_minus_rapidity: 1.0 / (velocity.gamma() + velocity.proper_speed()),
        }
    }

    /// The contours of a face at rest, in the axes of this frame.
    pub fn contours(&self, scene: &Scene, rest: &[DVec3], face: &Face) -> Vec<Vec<DVec3>> {
        let corner = |id: &ugscene::VertexId| self.aligned_from_scene(rest[id.index()]);
        scene.face_contours(face).map(|contour| contour.iter().map(corner).collect()).collect()
    }

    /// The rays of a row of samples, `y` down the picture; argument of [`PictureRays::ray`].
    pub fn row(&self, y: f64) -> DVec3 {
        self.rays[0] + y * self.rays[2]
    }

    /// The rays through the middles of a row of samples.
    pub fn row_of_samples(&self, row: u32) -> DVec3 {
        self.row(center(row))
    }

    /// The ray at `x` across the picture, in samples: the emission position at rest of light seen
    /// at depth 1.
    #[inline]
    pub fn ray(&self, row: DVec3, x: f64) -> DVec3 {
        self.rest(row + x * self.rays[1])
    }

    /// The same with its stretch.
    pub fn stretched_ray(&self, row: DVec3, x: f64) -> RestRay {
        let seen = row + x * self.rays[1];
        let rest = self.rest(seen);
        RestRay { rest, stretch: rest.length() / seen.length() }
    }

    /// The rays `across` samples across and one down from that with the ray `rest`.
    pub fn neighbours(&self, rest: DVec3, across: f64) -> [DVec3; 2] {
        let seen = self.seen(rest);
        [across * self.rays[1], self.rays[2]].map(|step| self.rest(seen + step))
    }

    /// The ray at the middle of a column. `length`: of the apparent ray.
    #[inline]
    pub fn ray_of_length(&self, row: DVec3, column: u32, length: f64) -> RestRay {
        let seen = row + center(column) * self.rays[1];
        if self.is_extreme() {
            let rest = self.rest(seen);
            return RestRay { rest, stretch: rest.length() / length };
        }
        // The boost is linear in the event at time −|p|.
        let (gamma, speed) = (self.velocity.gamma(), self.velocity.proper_speed());
        let rest = DVec3 { x: gamma * seen.x + speed * length, ..seen };
        RestRay { rest, stretch: (gamma * length + speed * seen.x) / length }
    }

    /// True if a boost cancels more digits than single precision allows.
    pub fn is_extreme(&self) -> bool {
        /// Cancellation amplifies rounding errors by 2γ²; here the error stays below 10⁻⁹.
        const MOST_GAMMA: f64 = 1000.0;
        self.velocity.gamma() > MOST_GAMMA
    }

    /// The dot product of rays at rest with `vector`.
    pub fn form(&self, vector: DVec3) -> Form {
        let of_seen = DVec3 { x: self.velocity.gamma() * vector.x, ..vector };
        let [origin, per_column, per_row] = self.rays.map(|ray| of_seen.dot(ray));
        Form { origin, per_column, per_row, per_length: self.velocity.proper_speed() * vector.x }
    }

    /// The plane through the eye and an edge. `normal`: of the plane.
    pub fn side(&self, normal: DVec3) -> Side {
        let size = (self.velocity.gamma() + self.velocity.proper_speed()) * normal.length();
        Side { form: self.form(normal), size }
    }

    /// The rest position of a point seen at `seen`.  Eq. (P4)
    #[inline]
    pub fn rest(&self, seen: DVec3) -> DVec3 {
        DVec3 { x: self.boosted(seen, self.velocity.proper_speed()), ..seen }
    }

    /// The apparent position of a point at rest.  Eq. (P3)
    #[inline]
    pub fn seen(&self, rest: DVec3) -> DVec3 {
        DVec3 { x: self.boosted(rest, -self.velocity.proper_speed()), ..rest }
    }

    /// γ a + u r, in the form of (P3) that does not cancel. `a`: component along the motion; `r`:
    /// distance.
    ///
    /// `ugphysics::seen_event` computes the same, along any direction: it scales the point and
    /// projects it twice. This runs for every sample, in axes that need neither.
    #[inline]
    fn boosted(&self, p: DVec3, proper_speed: f64) -> f64 {
        let (a, r) = (p.x, p.length());
        // Reversing the sign of both a and u reverses the sign of the result.
        let (b, speed) = if proper_speed < 0.0 { (-a, -proper_speed) } else { (a, proper_speed) };
        let sum = if b < 0.0 {
            b * self.exp_minus_rapidity + speed * (p.y * p.y + p.z * p.z) / (r - b)
        } else {
            self.velocity.gamma() * b + speed * r
        };
        if proper_speed < 0.0 { -sum } else { sum }
    }

    /// Rotates rest coordinates from the axes of the scene to those of this frame.
    pub fn aligned_from_scene(&self, rest: DVec3) -> DVec3 {
        self.scene_from_aligned.transpose() * rest
    }

    /// Projects an apparent position: its sample coordinates times the depth, and the depth.
    pub fn place(&self, seen: DVec3) -> DVec3 {
        self.samples_from_seen * seen
    }

    /// The apparent shape of a straight line at rest between two unit vectors: the three control
    /// points of a rational Bézier curve, in the coordinates of [`PictureRays::place`]. `None` if
    /// the line goes through the eye.
    ///
    /// The directions of the line form an arc of a great circle, with control points a,
    /// (a+b)/(1+a·b) of weight κ = cos φ/2, and b. With the time −1 they are points of a plane in
    /// spacetime, and the curve lies on the light cone. Boost and projection are linear, so they
    /// act on the control points.  Eq. (P8)
    pub fn arc(&self, a: DVec3, b: DVec3) -> Option<[DVec3; 3]> {
        /// cos φ/2 of a line that passes through the eye, within rounding.
        const LEAST: f64 = 1e-9;
        let sum = a + b;
        let kappa = 0.5 * sum.length();
        if kappa < LEAST {
            return None;
        }
        let middle = sum / (2.0 * kappa);
        let (gamma, speed) = (self.velocity.gamma(), self.velocity.proper_speed());
        let along = if middle.x > 0.0 {
            // γ(m − κ) + (γ − u)κ, with m² − κ² = sin² φ/2 − m_across².
            let across = middle.y * middle.y + middle.z * middle.z;
            let difference = 0.25 * (a - b).length_squared() - across;
            gamma * difference / (middle.x + kappa) + self.exp_minus_rapidity * kappa
        } else {
            gamma * middle.x - speed * kappa
        };
        let control = DVec3 { x: along, ..middle };
        Some([self.seen(a), control, self.seen(b)].map(|point| self.place(point)))
    }
}
