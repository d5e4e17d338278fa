//! The suite detects known mistakes. They are introduced into a copy of the crates, each behind a
//! switch, and each must make at least one case fail.
//!
//! The copy is in the target folder and shares the dependencies of the workspace, but all our
//! crates are built again. That takes minutes, so only `.ci/run` does it, with `UG_CI=1`.
//! `cargo test` checks that the source still contains every expression in the list.

use std::collections::BTreeMap;
use std::env;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::Command;

/// A mistake, and the case that must fail with it.
struct Mistake {
    name: &'static str,
    file: &'static str,
    /// An expression that occurs in the file once.
    right: &'static str,
    wrong: &'static str,
    /// A case, picture or topic that detects it; for a mistake in the ray tracer, a test of
    /// `ugphoton`.
    found_by: &'static str,
}

/// Some mistakes have no exact equivalent in our programs. M10 concerns renderers of panoramas;
/// here it is introduced into the aberration itself, which the suite asks for.
const MISTAKES: [Mistake; 21] = [
    Mistake {
        name: "M1",
        file: "crates/ugphysics/src/doppler.rs",
        right: "to_observer / power_of_two_below(to_observer)",
        wrong: "-crate::aberrate(-to_observer, v)",
        found_by: "T19",
    },
    Mistake {
        name: "M2",
        file: "crates/ugphysics/src/velocity.rs",
        right: "1.0 / gamma_inverse_squared.sqrt()",
        wrong: "1.0 / gamma_inverse_squared",
        found_by: "T01",
    },
    Mistake {
        name: "M3",
        file: "crates/ugphysics/src/lorentz.rs",
        right: "v.split(u.proper())",
        wrong: "(-v).split(u.proper())",
        found_by: "T32",
    },
    Mistake {
        name: "M4",
        file: "crates/ugscene/src/camera_options.rs",
        right: "half_width * samples[1] / samples[0]",
        wrong: "half_width",
        found_by: "wide",
    },
    Mistake {
        name: "M5",
        file: "crates/ugphysics/src/doppler.rs",
        right: "square * square",
        wrong: "square * doppler",
        found_by: "T20",
    },
    Mistake {
        name: "M6",
        file: "crates/ugrainbow/src/drawlist.rs",
        right: "scene.vertices.par_iter().map(point).collect()",
        wrong: "scene
            .vertices
            .par_iter()
            .enumerate()
            .map(|(row, vertex)| {
                let seen = vertex.position - painter.view.eye;
                let distance = painter.appearance.surface.rest(VertexId::from_index(row)).length();
                painter.point(painter.view.place(seen * (distance / seen.length())))
            })
            .collect()",
        found_by: "depth",
    },
    Mistake {
        name: "M7",
        file: "crates/uglight/src/hue.rs",
        right: "if self.doppler { doppler } else { 1.0 }",
        wrong: "doppler * doppler",
        found_by: "shift",
    },
    Mistake {
        name: "M8",
        file: "conformance/src/answer/light.rs",
        right: "power * (doppler * doppler)",
        wrong: "power * (doppler * doppler * doppler * doppler * doppler)",
        found_by: "T25",
    },
    Mistake {
        name: "M9",
        file: "crates/ugphysics/src/aberration.rs",
        right: "rest_position(d / d.abs().max_element(), v).normalize()",
        wrong: "(d.normalize() + v.beta()).normalize()",
        found_by: "T17",
    },
    Mistake {
        name: "M10",
        file: "crates/ugphysics/src/aberration.rs",
        right: "rest_position(d / d.abs().max_element(), v).normalize()",
        wrong: "{
            let seen = rest_position(d, v).normalize();
            let back = seen.dot(v.direction()).min(0.0);
            seen - 2.0 * back * v.direction()
        }",
        found_by: "T13",
    },
    Mistake {
        name: "M11",
        file: "crates/ugphysics/src/hyperbolic.rs",
        right: "libm::sinh(a * proper_time) / a",
        wrong: "proper_time",
        found_by: "T30",
    },
    Mistake {
        name: "M12",
        file: "conformance/src/answer/positions.rs",
        right: "elongated(normal, velocity(u)?)",
        wrong: "contracted(normal, velocity(u)?)",
        found_by: "T35",
    },
    Mistake {
        name: "M13",
        file: "crates/uglorentz/src/refined_mesh.rs",
        right: "Point::new(self.motion_of(body), body, rest)",
        wrong: "Point {
            seen: used().map(|(parent, weight)| self.point(parent).seen * weight).sum(),
            ..Point::new(self.motion_of(body), body, rest)
        }",
        found_by: "edge",
    },
    Mistake {
        name: "M14",
        file: "crates/ugimage/src/quantizer.rs",
        right: "srgb_decode((level as f64 + 1.0 - ROUNDING_OFFSET) / 255.0) as f32",
        wrong: "((level as f64 + 0.5) / 255.0) as f32",
        found_by: "colours",
    },
    // The second part of M14: a colour matrix for another white point.
    Mistake {
        name: "M14white",
        file: "crates/ugphysics/src/xyz.rs",
        right: "times(RGB_FROM_XYZ, xyz)",
        wrong: "times(
            [[2.3707, -0.9001, -0.4706], [-0.5139, 1.4253, 0.0886], [0.0053, -0.0147, 1.0094]],
            xyz,
        )",
        found_by: "colours",
    },
    Mistake {
        name: "M15",
        file: "crates/ugphysics/src/velocity.rs",
        right: "beta == DVec3::ZERO",
        wrong: "beta.length() < 0.01",
        found_by: "T18",
    },
    Mistake {
        name: "M16",
        file: "crates/ugphysics/src/doppler.rs",
        right: "1.0 / stretch\n",
        wrong: "f64::from(1.0_f32 / (v.gamma() as f32 * (1.0 - v.beta().dot(to_observer.normalize()) as f32)))\n",
        found_by: "T19",
    },
    Mistake {
        name: "M17",
        file: "crates/ugphysics/src/world_line/moving.rs",
        right: "self.root(point, observer, None)?",
        wrong: "{
            let (own_time, moment) = self.root(point, observer, None)?;
            let later = own_time + (observer.x - moment.event.x).length();
            (own_time, Moment { event: moment.event, ..self.moment(point, later)? })
        }",
        found_by: "T37",
    },
    Mistake {
        name: "M18",
        file: "crates/ugphysics/src/world_line/moving.rs",
        right: "self.root_of_turn(acceleration, point, observer, guess)",
        wrong: "{
            let now = self.offset(point, self.own_time_at(observer)?).xi + self.at;
            Self { turns: Vec::new(), ..self.clone() }.root_of_turn(acceleration, now, observer, guess)
        }",
        found_by: "T37",
    },
    Mistake {
        name: "M19",
        file: "crates/ugphysics/src/world_line/moving.rs",
        right: "self.emission_time(point, observer, guess)?",
        wrong: "self.emission_time(self.at, observer, guess)?",
        found_by: "T37",
    },
    Mistake {
        name: "M20",
        file: "crates/ugphysics/src/world_line/orbit.rs",
        right: "Lorentz::boost(velocity) * Lorentz::rotation(lag)",
        wrong: "Lorentz::boost(velocity)",
        found_by: "T38",
    },
];

/// Mistakes in `ugphoton`, each with the test of that crate that fails.
const RAY_MISTAKES: [Mistake; 5] = [
    Mistake {
        name: "M1rays",
        file: "crates/ugphysics/src/rest_frame.rs",
        right: "self.rest_from_camera(Event { t: wave.frequency, x: wave.k })",
        // The direction in the rest frame, in the formula for that in the frame of the camera.
        wrong: "{
            let seen = self.rest_from_camera(Event { t: wave.frequency, x: wave.k });
            let along = wave.frequency * seen.x.normalize().dot(self.velocity.direction());
            Event { t: self.velocity.gamma() * wave.frequency - self.velocity.proper_speed() * along, ..seen }
        }",
        found_by: "beaming::frequencies_are_those_of_the_doppler_effect",
    },
    Mistake {
        name: "M6rays",
        file: "crates/ugphoton/src/world.rs",
        right: "best.is_some() && hit.t >= end",
        // Distances in the rest frames of both bodies.
        wrong: "best.is_some_and(|best| {
            let weighted = best.triangle.corners.iter().zip(best.weights);
            let place: DVec3 = weighted.map(|(corner, weight)| weight * faces.rest[corner.index()]).sum();
            place.length() <= hit.t * step.length()
        })",
        found_by: "frames::what_emitted_last_is_in_front",
    },
    Mistake {
        name: "M7rays",
        file: "crates/ugphoton/src/surface_point.rs",
        right: "1.0 / self.wave.frequency",
        wrong: "1.0 / (self.wave.frequency * self.wave.frequency)",
        found_by: "beaming::frequencies_are_those_of_the_doppler_effect",
    },
    Mistake {
        name: "M8rays",
        file: "crates/uglight/src/hue.rs",
        right: "self.law.irradiance_factor(part.doppler)",
        wrong: "(self.law.factor(part.doppler) * part.doppler)",
        found_by: "beaming::moving_lamps_light_by_powers_of_their_doppler_factor",
    },
    Mistake {
        name: "M12rays",
        file: "crates/ugphoton/src/surface_point.rs",
        right: "scenery.faces().outside(found.triangle.face)",
        wrong: "{
            let normal = scenery.faces().outside(found.triangle.face);
            let v = part.frame.velocity();
            (normal - (1.0 - 1.0 / v.gamma()) * normal.dot(v.direction()) * v.direction()).normalize()
        }",
        found_by: "report::moving_mirrors_reflect_as_the_report_says",
    },
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// All files below `folder`, by their paths relative to `top`.
fn collect(top: &Path, folder: &Path, files: &mut BTreeMap<PathBuf, Vec<u8>>) {
    for entry in fs::read_dir(folder).expect("a folder of the workspace") {
        let path = entry.expect("an entry of it").path();
        if path.is_dir() {
            collect(top, &path, files);
        } else {
            let name = path.strip_prefix(top).expect("it lies below").to_path_buf();
            files.insert(name, fs::read(&path).expect("a file of the workspace"));
        }
    }
}

/// The workspace with all mistakes behind switches.
fn mistaken_workspace() -> BTreeMap<PathBuf, Vec<u8>> {
    let root = root();
    let mut files = BTreeMap::new();
    for folder in ["crates", "conformance/src", "conformance/cases", "conformance/scenes", "scenes"] {
        collect(&root, &root.join(folder), &mut files);
    }
    for name in ["Cargo.toml", "Cargo.lock", "conformance/Cargo.toml"] {
        files.insert(name.into(), fs::read(root.join(name)).expect("a file of the workspace"));
    }
    for Mistake { name, file, right, wrong, .. } in MISTAKES.iter().chain(&RAY_MISTAKES) {
        let (value, end) = (right.trim_end(), &right[right.trim_end().len()..]);
        let switch = format!(
            "({{ static MISTAKE: std::sync::LazyLock<bool> = std::sync::LazyLock::new(|| \
             std::env::var(\"UG_MISTAKE\").is_ok_and(|name| name == \"{name}\")); \
             if *MISTAKE {{ {} }} else {{ {value} }} }}){end}",
            wrong.trim_end(),
        );
        // `end` is text after the value that makes the expression unique.
        edit(&mut files, file, right, &switch);
    }
    edit(&mut files, "Cargo.toml", ", \"tests\", \"xtask\"]", "]");
    // A different version: otherwise cargo would use its builds of the original crates.
    let version = concat!("version = \"", env!("CARGO_PKG_VERSION"), "\"\nedition");
    edit(&mut files, "Cargo.toml", version, "version = \"0.0.0-mistaken\"\nedition");
    // And a different name, so that it does not replace the original program in the target folder.
    let program = "[dependencies]\n";
    let renamed = "[[bin]]\nname = \"ugmistakes\"\npath = \"src/main.rs\"\n\n[dependencies]\n";
    edit(&mut files, "conformance/Cargo.toml", program, renamed);
    files
}

#[track_caller]
fn edit(files: &mut BTreeMap<PathBuf, Vec<u8>>, file: &str, right: &str, wrong: &str) {
    let text = files.get_mut(Path::new(file)).unwrap_or_else(|| panic!("{file} is not in the workspace"));
    let before = String::from_utf8(std::mem::take(text)).expect("source is text");
    let n_found = before.matches(right).count();
    assert_eq!(n_found, 1, "{file}: `{right}` must stand there once; correct the list of mistakes");
    *text = before.replace(right, wrong).into_bytes();
}

/// Synchronises `folder` with these files; unchanged files are not written, so that they are not
/// built again.
fn put(folder: &Path, files: &BTreeMap<PathBuf, Vec<u8>>) {
    let mut old = BTreeMap::new();
    if folder.exists() {
        collect(folder, folder, &mut old);
    }
    for name in old.keys().filter(|name| !files.contains_key(*name)) {
        fs::remove_file(folder.join(name)).expect("an old file of ours");
    }
    for (name, bytes) in files.iter().filter(|(name, bytes)| old.get(*name) != Some(bytes)) {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder of ours");
        fs::write(path, bytes).expect("a file of ours");
    }
}

/// The failures that `check` reports.
fn wrong(program: &Path, mistake: &str) -> Vec<String> {
    let output = Command::new(program).arg("check").env("UG_MISTAKE", mistake).output().expect("it runs");
    let text = String::from_utf8_lossy(&output.stdout);
    let talk = String::from_utf8_lossy(&output.stderr);
    let last = text.lines().last().and_then(|line| line.strip_prefix("wrong: "));
    let last = last.unwrap_or_else(|| panic!("{mistake}: no verdict: {talk}"));
    let found: Vec<String> = last.split(' ').filter(|word| *word != "nothing").map(str::to_string).collect();
    assert_eq!(output.status.success(), found.is_empty(), "{mistake}: status and verdict agree");
    found
}

/// The tests of the ray tracer that fail.
fn failed_laws(folder: &Path, target: &Path, mistake: &str) -> Vec<String> {
    let mut tests = Command::new(env!("CARGO"));
    tests.args(["test", "--quiet", "--offline", "--package", "ugphoton", "--test", "laws"]);
    tests.arg("--target-dir").arg(target).current_dir(folder).env("UG_MISTAKE", mistake);
    if !cfg!(debug_assertions) {
        tests.arg("--release");
    }
    tests.args(["--", "--format", "pretty"]);
    let output = tests.output().expect("cargo runs");
    let text = String::from_utf8_lossy(&output.stdout);
    let talk = String::from_utf8_lossy(&output.stderr);
    let results: Vec<(&str, &str)> =
        text.lines().filter_map(|line| line.strip_prefix("test ")?.split_once(" ... ")).collect();
    assert!(results.len() > 20, "{mistake}: no tests: {text}{talk}");
    let failed = results.into_iter().filter(|(_, result)| *result == "FAILED");
    let failed: Vec<String> = failed.map(|(name, _)| name.to_string()).collect();
    assert_eq!(output.status.success(), failed.is_empty(), "{mistake}: status and results agree");
    failed
}

#[test]
fn every_mistake_has_its_place_in_the_source() {
    mistaken_workspace();
    let known = ugconformance::mistakes::MISTAKES.map(|(name, _)| name);
    let missing: Vec<_> = known.iter().filter(|name| !MISTAKES.iter().any(|m| m.name == **name)).collect();
    assert!(missing.is_empty(), "{missing:?} are not tried: add them to the list in {}", file!());
}

#[test]
fn every_mistake_is_found() {
    if env::var_os("UG_CI").is_none_or(|value| value != "1") {
        // To standard error itself, since the output of a test that passes is hidden.
        let _ = writeln!(io::stderr(), "skipped: the mistakes are not built in: only `.ci/run` does it");
        return;
    }
    let scratch = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let folder = scratch.join("mistakes");
    put(&folder, &mistaken_workspace());
    let target = scratch.parent().expect("the target folder");
    let mut build = Command::new(env!("CARGO"));
    build.args(["build", "--quiet", "--offline", "--workspace", "--bin", "ugmistakes"]);
    build.arg("--target-dir").arg(target).current_dir(&folder);
    if !cfg!(debug_assertions) {
        build.arg("--release");
    }
    let output = build.output().expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let profile = if cfg!(debug_assertions) { "debug" } else { "release" };
    let program = target.join(profile).join(format!("ugmistakes{}", env::consts::EXE_SUFFIX));

    assert_eq!(wrong(&program, ""), [""; 0], "without a mistake nothing fails");
    for Mistake { name, found_by, .. } in &MISTAKES {
        let found = wrong(&program, name);
        let some: Vec<_> = found.iter().rev().take(8).map(String::as_str).collect();
        println!("{name}: {} cases, among them {}", found.len(), some.join(" "));
        let is_it = |case: &String| case == found_by || case.split('.').next() == Some(found_by);
        assert!(found.iter().any(is_it), "{name} is not found by {found_by}: {found:?}");
    }

    assert_eq!(failed_laws(&folder, target, ""), [""; 0], "without a mistake nothing fails");
    for Mistake { name, found_by, .. } in &RAY_MISTAKES {
        let failed = failed_laws(&folder, target, name);
        println!("{name}: {} tests of the ray tracer", failed.len());
        assert!(failed.iter().any(|test| test == found_by), "{name} is not found by {found_by}: {failed:?}");
    }
}
