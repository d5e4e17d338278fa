//! Films at growing speed: constant proper acceleration along a line.

use std::process::Command;

use ugtests::{programs, scenes};

/// Velocities of 1 g, 9.80665 m/s², in light years and Julian years.
const PER_YEAR: f64 = 9.806_65 * 31_557_600.0 / 299_792_458.0;

/// The velocities along y of the frames of a film, as its commands say.
fn velocities(n_frames: u32, last: f64) -> Vec<f64> {
    let program = programs::folder().join("ugfilm");
    let moving = format!("0 0 0 .. 0 {last} 0");
    let output = Command::new(program)
        .args(["-warp", "-frames", &n_frames.to_string(), "-cv", &moving])
        .args(["-fo", "f_%d.png", "--print", "stars.csv"])
        .current_dir(scenes::root().join("scenes"))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let commands = String::from_utf8(output.stdout).unwrap();
    let velocity = |command: &str| -> f64 {
        let (_, rest) = command.split_once(" -cv 0 ").unwrap();
        rest.split(' ').next().unwrap().parse().unwrap()
    };
    commands.lines().map(velocity).collect()
}

/// Velocity, distance and time of a traveller at 1 g after whole years of proper time, published
/// for relativistic rockets: v = tanh aτ, t = sinh(aτ)/a, x = (cosh(aτ) − 1)/a.
#[test]
fn equal_steps_are_constant_proper_acceleration() {
    const N: usize = 2001;
    let found = velocities(N as u32, 0.968_317_848_7);
    assert_eq!(found.len(), N);
    let step = 2.0 / (N - 1) as f64;
    let (mut time, mut distance) = (0.0, 0.0);
    for (idx, ends) in found.windows(2).enumerate() {
        // dt = γ dτ and dx = γβ dτ.
        let gamma = |beta: f64| 1.0 / (1.0 - beta * beta).sqrt();
        let [from, to] = [ends[0], ends[1]];
        time += 0.5 * step * (gamma(from) + gamma(to));
        distance += 0.5 * step * (from * gamma(from) + to * gamma(to));
        let year = (idx + 1) as f64 * step;
        let expected = libm::tanh(PER_YEAR * year);
        assert!((to - expected).abs() < 1e-8, "{year}: {to}, not {expected}");
        let published = match idx + 1 {
            1000 => [0.774_827_262_6, 1.187_312_402, 0.563_642_465_1],
            2000 => [0.968_317_848_7, 3.756_289_45, 2.910_475_472],
            _ => continue,
        };
        for (found, expected) in [to, time, distance].into_iter().zip(published) {
            assert!((found - expected).abs() < 1e-5, "{year}: {found}, not {expected}");
        }
    }
}
