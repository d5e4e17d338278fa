//! The events of a diagram and its intervals as CSV.

use std::fmt::Write;

use ugphysics::Event;

use crate::diagram::{Diagram, MarkRole};

/// The first line of the table.
const HEAD: &str = "what,name,line,frame,t,x,y,z,own_time,kind,square";

/// A row for each event and each interval in each frame: that of the scene, of the camera, of the
/// diagram, and those that its options name. An interval has the differences of both events in t, x,
/// y, z, its length in `own_time` if it is timelike, and c²Δt² − Δx² − Δy² − Δz² in `square`.
pub fn table(diagram: &Diagram) -> String {
    let mut text = format!("{HEAD}\n");
    let mut row = |what: &str, [name, line, frame]: [&str; 3], event: Event, rest: &str| {
        let ([x, y, z], t) = (event.x.to_array(), event.t);
        let written = writeln!(text, "{what},{name},{line},{frame},{t},{x},{y},{z},{rest}");
        written.expect("writing to memory does not fail");
    };
    for mark in diagram.marks.iter().filter(|mark| mark.role != MarkRole::AxisTick) {
        let own_time = mark.own_time.map_or_else(String::new, |time| time.to_string());
        for frame in &diagram.frames {
            let names = [&*mark.name, &mark.line, &frame.name];
            let coordinates = frame.coordinates(mark.event);
            row(
                mark.role.name(),
                names.map(plain).each_ref().map(|name| &**name),
                coordinates,
                &format!("{own_time},,"),
            );
        }
    }
    for measured in &diagram.intervals {
        let names = measured.names.join(" to ");
        let interval = measured.interval;
        let own_time =
            if interval.square > 0.0 { interval.length().to_string() } else { String::new() };
        let rest = format!("{own_time},{},{}", interval.kind.name(), interval.square);
        for frame in &diagram.frames {
            let components = frame.components(measured.difference);
            let names = [&*names, "", &frame.name];
            row("interval", names.map(plain).each_ref().map(|name| &**name), components, &rest);
        }
    }
    text
}

/// A name without the separator of columns.
fn plain(name: &str) -> String {
    name.replace([',', '"', '\n'], ";")
}
