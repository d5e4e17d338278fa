//! The geometry of a diagram: lines, marks and bands in its coordinates.

use glam::DVec3;
use ugphysics::{Event, Velocity};

use crate::config::{DiagramOptions, PointChoice, TickChoice};
use crate::error::Error;
use crate::frame::ReferenceFrame;
use crate::interval::Interval;
use crate::place::DiagramPlace;
use crate::spacetime::{Ink, Spacetime, SpacetimeLine};
use crate::window::DiagramWindow;
use crate::words::{EventWord, FrameOwner, FrameWord};
use crate::world_line::curve;

/// A diagram, in the coordinates of its frame.
#[derive(Clone, Debug)]
pub struct Diagram {
    /// The frame whose time and place it has.
    pub frame: ReferenceFrame,
    /// The direction of space across, a unit vector in the axes of the frame.
    pub axis: DVec3,
    /// Where the axis is from.
    pub axis_source: AxisSource,
    /// What is seen of time and space.
    pub window: DiagramWindow,
    /// Bodies, between the world lines of their ends.
    pub bands: Vec<BodyBand>,
    /// Lines, in painting order.
    pub curves: Vec<DiagramCurve>,
    /// Marks, in painting order.
    pub marks: Vec<DiagramMark>,
    /// Intervals that are measured.
    pub intervals: Vec<MeasuredInterval>,
    /// Frames in which events and intervals are stated.
    pub frames: Vec<ReferenceFrame>,
    /// Own time between ticks; 0 without ticks.
    pub step: f64,
    /// Lines that are left out, each behind the one that it coincides with.
    pub coincident: Vec<[String; 2]>,
}

/// Where the axis of a diagram is from.
#[derive(Clone, Debug, PartialEq)]
pub enum AxisSource {
    /// The options.
    Given,
    /// The motion of this line.
    Motion(String),
    /// Nothing moves.
    Rest,
}

/// What a line of a diagram is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurveRole {
    /// A world line.
    WorldLine,
    /// An edge of a light cone.
    Light,
    /// Events that are simultaneous in a frame.
    Simultaneity,
    /// The time axis of a frame.
    TimeAxis,
    /// The space axis of a frame.
    SpaceAxis,
    /// From one event to another.
    Interval,
}

/// A line of a diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct DiagramCurve {
    /// What it is.
    pub role: CurveRole,
    /// What it belongs to.
    pub name: String,
    /// Its label; empty for none.
    pub label: String,
    /// Its colour.
    pub color: Ink,
    /// Its corners.
    pub points: Vec<DiagramPlace>,
}

/// What a mark of a diagram is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MarkRole {
    /// The camera takes the picture.
    Eye,
    /// An event of the options.
    Event,
    /// A lamp lights up.
    Flash,
    /// Light of the picture left a vertex.
    Emission,
    /// A clock shows a round number.
    Tick,
    /// A round number on the axis of another frame.
    AxisTick,
}

impl MarkRole {
    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Eye => "eye",
            Self::Event => "event",
            Self::Flash => "flash",
            Self::Emission => "emission",
            Self::Tick | Self::AxisTick => "tick",
        }
    }
}

/// A mark of a diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct DiagramMark {
    /// What it is.
    pub role: MarkRole,
    /// The name of the event or vertex, or the number of a tick.
    pub name: String,
    /// The line it is on.
    pub line: String,
    /// True if its name is written beside it.
    pub is_labelled: bool,
    /// The event, in the frame of the camera with the event of the eye as origin.
    pub event: Event,
    /// Its place in the diagram.
    pub place: DiagramPlace,
    /// The own time of its line there, if it is on one.
    pub own_time: Option<f64>,
    /// The direction of the line that a tick is on.
    pub along: DiagramPlace,
    /// Its colour.
    pub color: Ink,
}

/// A body that extends along the axis, between the world lines of its ends.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyBand {
    /// Its name.
    pub name: String,
    /// Its colour.
    pub color: Ink,
    /// Times, and the places of both ends at each.
    pub rows: Vec<(f64, [f64; 2])>,
}

/// The interval of two events.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredInterval {
    /// The names of both.
    pub names: [String; 2],
    /// The second minus the first, in the frame of the camera.
    pub difference: Event,
    /// Its kind and square.
    pub interval: Interval,
}

/// The colour of light.
const LIGHT: Ink = [184, 134, 11];

/// The colour of events and intervals of the options.
const INK: Ink = [0; 3];

/// Times at which bands have rows.
const BAND_ROWS: usize = 256;

/// The most ticks of a line.
const MOST_TICKS: f64 = 400.0;

/// The most flashes of a lamp.
const MOST_FLASHES: usize = 40;

impl Diagram {
    /// The diagram of a spacetime. `ratio`: width over height of the part of the picture that it
    /// fills, in which a unit of time is as long as a unit of space.
    ///
    /// # Errors
    /// See [`Error`].
    pub fn new(spacetime: &Spacetime, options: &DiagramOptions, ratio: f64) -> Result<Self, Error> {
        let chosen = match &options.lines {
            Some(names) => {
                names.iter().map(|name| spacetime.line(name)).collect::<Result<Vec<_>, _>>()?
            }
            None => (0..spacetime.lines.len()).collect(),
        };
        let frame = spacetime.frame(&options.frame)?;
        let (axis, axis_source) = axis(spacetime, options, &frame, &chosen)?;
        let mut plan = Plan::new(spacetime, options, &frame, axis)?;
        plan.shows_eye |= !options.without_cone
            || options.points != PointChoice::None
            || chosen.contains(&spacetime.camera_line());
        let mut out = Self {
            frames: plan.frames.clone(),
            frame,
            axis,
            axis_source,
            window: DiagramWindow::EMPTY,
            bands: Vec::new(),
            curves: Vec::new(),
            marks: Vec::new(),
            intervals: Vec::new(),
            step: 0.0,
            coincident: Vec::new(),
        };
        out.add_emissions(spacetime, options, &chosen)?;
        out.add_events(spacetime, &plan);
        let keys = out.keys(spacetime, &plan, &chosen)?;
        out.window = DiagramWindow::new(&keys, options.times, options.places, ratio)?;
        out.step = match options.ticks {
            TickChoice::Off => 0.0,
            TickChoice::Auto => crate::window::round_step(out.window.duration() / 8.0),
            TickChoice::Every(step) if step > 0.0 && out.window.duration() <= MOST_TICKS * step => {
                step
            }
            TickChoice::Every(_) => return Err(Error::Ticks),
        };
        if !options.without_cone {
            out.add_cone("camera", Event::ORIGIN, &[-1.0]);
        }
        for (name, event) in &plan.cones {
            out.add_cone(name, *event, &[-1.0, 1.0]);
        }
        let shown = out.add_lines(spacetime, &chosen, options.lines.is_none())?;
        for &(ref reference, event, row) in &plan.simultaneous {
            let (color, time) = (plan.color(row), reference.coordinates(event).t);
            let label = format!("{}: t = {}", reference.name, short(time));
            out.push_line(CurveRole::Simultaneity, &reference.name, label, color, {
                let [slope, _] = out.directions(reference);
                out.window.line(out.place(event), slope)
            });
        }
        for (idx, &(ref reference, event, row)) in plan.axes.iter().enumerate() {
            out.add_axes(reference, event, plan.color(row), idx);
        }
        out.add_flashes(spacetime, &chosen)?;
        if out.step > 0.0 {
            shown.into_iter().try_for_each(|row| out.add_ticks(spacetime, row))?;
        }
        Ok(out)
    }

    /// The place of an event.
    pub fn place(&self, event: Event) -> DiagramPlace {
        let Event { t, x } = self.frame.coordinates(event);
        [self.axis.dot(x), t]
    }

    /// The directions, along the plane of the diagram, of events that are simultaneous in another
    /// frame, and of a clock that rests in it.
    ///
    /// A line of simultaneity is the section of the space of that frame with the plane of the
    /// diagram: with the four-velocity u = γ(1, β) and the axis n, (Δx, Δt) = (1, β·n) is orthogonal
    /// to u. Eq. (P7)
    fn directions(&self, reference: &ReferenceFrame) -> [DiagramPlace; 2] {
        let Event { t, x } = self.frame.components(reference.four_velocity());
        [[1.0, self.axis.dot(x) / t], [self.axis.dot(x), t]]
    }

    fn push_line(
        &mut self,
        role: CurveRole,
        name: &str,
        label: String,
        color: Ink,
        ends: Option<[DiagramPlace; 2]>,
    ) {
        if let Some(ends) = ends {
            let (name, points) = (name.to_owned(), ends.to_vec());
            self.curves.push(DiagramCurve { role, name, label, color, points });
        }
    }

    /// A mark on a line.
    fn mark(
        &self,
        (role, name, line): (MarkRole, &str, &str),
        (event, own_time): (Event, Option<f64>),
        color: Ink,
    ) -> DiagramMark {
        let is_labelled = matches!(role, MarkRole::Eye | MarkRole::Event | MarkRole::Tick);
        let (name, line, place) = (name.to_owned(), line.to_owned(), self.place(event));
        let along = [0.0; 2];
        DiagramMark { role, name, line, is_labelled, event, place, own_time, along, color }
    }

    /// What the window has to contain, besides the first marks.
    fn keys(
        &self,
        spacetime: &Spacetime,
        plan: &Plan,
        chosen: &[usize],
    ) -> Result<Vec<DiagramPlace>, Error> {
        let through = plan.simultaneous.iter().chain(&plan.axes).map(|(_, event, _)| *event);
        let mut events: Vec<Event> = through.collect();
        for line in chosen.iter().map(|&row| &spacetime.lines[row]) {
            for &own_time in &line.changes {
                events.push(line.event(line.point, own_time)?);
            }
        }
        let flashes = spacetime.flashes.iter().filter(|flash| chosen.contains(&flash.line));
        for flash in flashes.filter(|flash| flash.period.is_none()) {
            for &own_time in &flash.own_times {
                events.push(spacetime.lines[flash.line].event(flash.point, own_time)?);
            }
        }
        let marks = self.marks.iter().map(|mark| mark.place);
        Ok(marks.chain(events.into_iter().map(|event| self.place(event))).collect())
    }

    /// Adds both edges of a light cone. `sides`: −1 for the past, 1 for the future.
    fn add_cone(&mut self, name: &str, event: Event, sides: &[f64]) {
        let place = self.place(event);
        for &side in sides {
            for across in [-1.0, 1.0] {
                let ray = self.window.ray(place, [across, side]);
                self.push_line(CurveRole::Light, name, String::new(), LIGHT, ray);
            }
        }
    }

    /// Adds world lines and bands. Returns the rows of those that are drawn. `hides`: leave out
    /// lines that coincide with others.
    fn add_lines(
        &mut self,
        spacetime: &Spacetime,
        chosen: &[usize],
        hides: bool,
    ) -> Result<Vec<usize>, Error> {
        /// Part of the width within which lines coincide.
        const CLOSE: f64 = 2e-3;
        const SAMPLES: usize = 9;
        let [from, to] = self.window.times;
        let times =
            |n: usize| (0..n).map(move |row| from + (to - from) * row as f64 / (n - 1) as f64);
        let mut shown: Vec<(usize, Vec<f64>)> = Vec::new();
        for &row in chosen {
            let line = &spacetime.lines[row];
            let along = |point: DVec3, time: f64| {
                Ok::<_, Error>(self.place(line.at_time(point, &self.frame, time)?.0)[0])
            };
            let places = times(SAMPLES)
                .map(|time| along(line.point, time))
                .collect::<Result<Vec<_>, _>>()?;
            let close = CLOSE * self.window.width();
            let is_same = |(_, other): &&(usize, Vec<f64>)| {
                other.iter().zip(&places).all(|(a, b)| (a - b).abs() < close)
            };
            if let Some((other, _)) = shown.iter().find(is_same).filter(|_| hides) {
                let names = [row, *other].map(|row| spacetime.lines[row].name.clone());
                self.coincident.push(names);
                continue;
            }
            if let Some(ends) = self.ends(line) {
                let rows = times(BAND_ROWS)
                    .map(|time| Ok((time, [along(ends[0], time)?, along(ends[1], time)?])))
                    .collect::<Result<Vec<_>, Error>>()?;
                let widest = rows.iter().map(|(_, [a, b])| (a - b).abs()).fold(0.0, f64::max);
                if widest > 4.0 * close {
                    let (name, color) = (line.name.clone(), line.color);
                    self.bands.push(BodyBand { name, color, rows });
                }
            }
            let points = curve(&line.motion, line.point, &self.frame, self.axis, &self.window)
                .map_err(Error::of_line(&line.name))?;
            self.curves.push(DiagramCurve {
                role: CurveRole::WorldLine,
                name: line.name.clone(),
                label: line.name.clone(),
                color: line.color,
                points,
            });
            shown.push((row, places));
        }
        Ok(shown.into_iter().map(|(row, _)| row).collect())
    }

    /// The vertices of a body that are its ends along the axis, all of them moving alike.
    fn ends(&self, line: &SpacetimeLine) -> Option<[DVec3; 2]> {
        let own_time = line.motion.own_time_when(Event::ORIGIN, self.frame.from_camera());
        let pose = self.frame.from_camera() * line.motion.pose(own_time).scene_from_axes;
        let velocity = pose.velocity_of_frame().ok()?.beta();
        // At one time of the frame, from events at one own time.
        let along = |vertex: &DVec3| {
            let Event { t, x } = pose.apply(Event { t: 0.0, x: *vertex });
            self.axis.dot(x - velocity * t)
        };
        let by_place = |a: &&DVec3, b: &&DVec3| along(a).total_cmp(&along(b));
        let vertices = || line.vertices.iter();
        Some([*vertices().min_by(by_place)?, *vertices().max_by(by_place)?])
    }

    /// Adds both axes of a frame, with ticks.
    fn add_axes(&mut self, reference: &ReferenceFrame, event: Event, color: Ink, idx: usize) {
        let primes = "′".repeat(idx + 1);
        let place = self.place(event);
        let [space, clock] = self.directions(reference);
        let name = &reference.name;
        let ends = [self.window.line(place, clock), self.window.line(place, space)];
        self.push_line(CurveRole::TimeAxis, name, format!("ct{primes}"), color, ends[0]);
        self.push_line(CurveRole::SpaceAxis, name, format!("x{primes}"), color, ends[1]);
        if self.step == 0.0 {
            return;
        }
        // A unit of proper length along the line of simultaneity.
        let unit = 1.0 / (1.0 - space[1] * space[1]).sqrt();
        let now = reference.coordinates(event).t;
        let first = now / self.step;
        let axes = [(clock, first), (space.map(|part| unit * part), 0.0)];
        for (along, first) in axes {
            for number in numbers_in_window(&self.window, place, along, first, self.step) {
                let passed = (number - first) * self.step;
                let at = [0, 1].map(|part| place[part] + passed * along[part]);
                let mark = self.mark((MarkRole::AxisTick, "", name), (event, None), color);
                self.marks.push(DiagramMark { place: at, along, ..mark });
            }
        }
    }

    /// Adds the events at which the light of the picture left.
    fn add_emissions(
        &mut self,
        spacetime: &Spacetime,
        options: &DiagramOptions,
        chosen: &[usize],
    ) -> Result<(), Error> {
        let names: &[String] = match &options.points {
            PointChoice::Named(names) => names,
            _ => &[],
        };
        for name in names {
            if !spacetime.lights.iter().any(|light| light.vertex == *name) {
                return Err(Error::UnknownEvent(name.clone()));
            }
        }
        for light in &spacetime.lights {
            let is_named = names.contains(&light.vertex);
            let is_shown = options.points == PointChoice::All && chosen.contains(&light.line);
            if !is_named && !is_shown {
                continue;
            }
            let line = &spacetime.lines[light.line];
            let of = (MarkRole::Emission, &*light.vertex, &*line.name);
            let mark = self.mark(of, (light.event, Some(light.own_time)), line.color);
            self.marks.push(DiagramMark { is_labelled: is_named, ..mark });
        }
        Ok(())
    }

    /// Adds flashes and their light cones.
    fn add_flashes(&mut self, spacetime: &Spacetime, chosen: &[usize]) -> Result<(), Error> {
        for flash in spacetime.flashes.iter().filter(|flash| chosen.contains(&flash.line)) {
            let line = &spacetime.lines[flash.line];
            let [first, last] = self.window.times;
            let mut own_times = flash.own_times.clone();
            if let Some(period) = flash.period {
                let own_time =
                    |time| Ok::<_, Error>(line.at_time(flash.point, &self.frame, time)?.1);
                own_times = repeated(&own_times, period, [own_time(first)?, own_time(last)?]);
            }
            for own_time in own_times {
                let event = line.event(flash.point, own_time)?;
                let of = (MarkRole::Flash, &*line.name, &*line.name);
                let mark = self.mark(of, (event, Some(own_time)), LIGHT);
                if (first..=last).contains(&mark.place[1]) {
                    self.add_cone(&line.name, event, &[1.0]);
                    self.marks.push(mark);
                }
            }
        }
        Ok(())
    }

    /// Adds ticks of own time to a line.
    fn add_ticks(&mut self, spacetime: &Spacetime, row: usize) -> Result<(), Error> {
        let line = &spacetime.lines[row];
        let number =
            |time: f64| Ok::<_, Error>(line.at_time(line.point, &self.frame, time)?.1 / self.step);
        let [from, to] = self.window.times;
        for number in whole_numbers(number(from)?, number(to)?) {
            let own_time = number * self.step;
            let event = line.event(line.point, own_time)?;
            if self.window.contains(self.place(event)) {
                let along = self.directions(&spacetime.frame_of(row, Some(own_time))?)[1];
                let of = (MarkRole::Tick, &*short(own_time), &*line.name);
                let mark = self.mark(of, (event, Some(own_time)), line.color);
                self.marks.push(DiagramMark { along, ..mark });
            }
        }
        Ok(())
    }

    /// Adds the events of the options, and their intervals.
    fn add_events(&mut self, spacetime: &Spacetime, plan: &Plan) {
        let camera = &spacetime.lines[spacetime.camera_line()].name;
        let time = Some(spacetime.camera_frame().coordinates(Event::ORIGIN).t);
        if plan.shows_eye {
            let of = (MarkRole::Eye, "eye", &**camera);
            self.marks.push(self.mark(of, (Event::ORIGIN, time), INK));
        }
        for (name, event) in &plan.events {
            self.marks.push(self.mark((MarkRole::Event, name, ""), (*event, None), INK));
        }
        for (names, [from, to]) in &plan.intervals {
            let ends = Some([*from, *to].map(|event| self.place(event)));
            let name = names.join(" – ");
            self.push_line(CurveRole::Interval, &name, String::new(), INK, ends);
            let difference = *to - *from;
            let interval = Interval::of(difference);
            self.intervals.push(MeasuredInterval { names: names.clone(), difference, interval });
        }
    }
}

/// The axis of a diagram: that of the options, or of the fastest motion in its frame.
fn axis(
    spacetime: &Spacetime,
    options: &DiagramOptions,
    frame: &ReferenceFrame,
    chosen: &[usize],
) -> Result<(DVec3, AxisSource), Error> {
    /// Speeds that are rounding.
    const REST: f64 = 1e-9;
    if let Some(axis) = options.axis {
        let axis = ugphysics::unit_or_zero(axis);
        return if axis == DVec3::ZERO { Err(Error::Axis) } else { Ok((axis, AxisSource::Given)) };
    }
    let mut best = (REST, Velocity::ZERO, None);
    for &row in chosen {
        let line = &spacetime.lines[row];
        let mut times = line.changes.clone();
        times.push(line.motion.own_time_when(Event::ORIGIN, frame.from_camera()));
        times.sort_by(f64::total_cmp);
        let middles: Vec<f64> = times.windows(2).map(|pair| pair[0].midpoint(pair[1])).collect();
        for own_time in times.into_iter().chain(middles) {
            let axes = frame.from_camera() * line.motion.frame(line.point, own_time);
            // A difference that matters, so that rounding does not choose between equal speeds.
            if let Ok(velocity) = axes.velocity_of_frame()
                && velocity.rapidity() > best.0 * (1.0 + 1e-6)
            {
                best = (velocity.rapidity(), velocity, Some(&line.name));
            }
        }
    }
    let (_, velocity, Some(name)) = best else { return Ok((DVec3::X, AxisSource::Rest)) };
    let direction = velocity.direction();
    // Rounding is no direction.
    let clean = |part: f64| if part.abs() < REST { 0.0 } else { part };
    let direction = direction.to_array().map(clean);
    let direction = DVec3::from_array(direction).normalize_or(DVec3::X);
    let largest = direction[direction.abs().max_position()];
    Ok((direction * largest.signum(), AxisSource::Motion(name.clone())))
}

/// The numbers of ticks along a line through `place` that are in the window. `first`: of the
/// place.
fn numbers_in_window(
    window: &DiagramWindow,
    place: DiagramPlace,
    direction: DiagramPlace,
    first: f64,
    step: f64,
) -> Vec<f64> {
    let Some(ends) = window.line(place, direction) else { return Vec::new() };
    let number = |end: DiagramPlace| {
        let part = if direction[0].abs() > direction[1].abs() { 0 } else { 1 };
        first + (end[part] - place[part]) / (direction[part] * step)
    };
    let [low, high] = ends.map(number);
    whole_numbers(low.min(high), low.max(high))
}

/// The whole numbers in a range; none if they are too many.
fn whole_numbers(low: f64, high: f64) -> Vec<f64> {
    let (low, high) = (low.ceil(), high.floor());
    if high - low > MOST_TICKS {
        return Vec::new();
    }
    (0..).map(|row| low + f64::from(row)).take_while(|number| *number <= high).collect()
}

/// Own times that repeat after a period, in a range.
fn repeated(own_times: &[f64], period: f64, [from, to]: [f64; 2]) -> Vec<f64> {
    let mut all = Vec::new();
    for &own_time in own_times {
        let first = ((from - own_time) / period).ceil();
        let times = (0..MOST_FLASHES).map(|row| own_time + (first + row as f64) * period);
        all.extend(times.take_while(|time| *time <= to));
    }
    all
}

/// A number with four digits.
fn short(number: f64) -> String {
    // Not −0, nor the rounding of a sum.
    let number = if number.abs() < 1e-12 { 0.0 } else { number };
    ugimage::label::number::significant(number, 4)
}

/// The events and frames that the options name.
struct Plan<'s> {
    spacetime: &'s Spacetime,
    axis: DVec3,
    events: Vec<(String, Event)>,
    intervals: Vec<([String; 2], [Event; 2])>,
    simultaneous: Vec<(ReferenceFrame, Event, Option<usize>)>,
    axes: Vec<(ReferenceFrame, Event, Option<usize>)>,
    cones: Vec<(String, Event)>,
    frames: Vec<ReferenceFrame>,
    /// The eye has a mark.
    shows_eye: bool,
}

impl<'s> Plan<'s> {
    fn new(
        spacetime: &'s Spacetime,
        options: &DiagramOptions,
        frame: &ReferenceFrame,
        axis: DVec3,
    ) -> Result<Self, Error> {
        let mut plan = Self {
            spacetime,
            axis,
            events: Vec::new(),
            intervals: Vec::new(),
            simultaneous: Vec::new(),
            axes: Vec::new(),
            cones: Vec::new(),
            frames: vec![spacetime.scene_frame(), spacetime.camera_frame()],
            shows_eye: false,
        };
        plan.add_frame(frame);
        for named in &options.events {
            if plan.events.iter().any(|(name, _)| *name == named.name) {
                return Err(Error::SameName(named.name.clone()));
            }
            let event = plan.event(&named.event)?.1;
            plan.events.push((named.name.clone(), event));
        }
        for [from, to] in &options.intervals {
            let (from, to) = (plan.marked(from)?, plan.marked(to)?);
            plan.intervals.push(([from.0, to.0], [from.1, to.1]));
        }
        for (word, event) in &options.simultaneous {
            let through = plan.frame_through(word, event)?;
            plan.simultaneous.push(through);
        }
        for (word, event) in &options.axes {
            let through = plan.frame_through(word, event)?;
            plan.axes.push(through);
        }
        for word in &options.cones {
            let event = plan.marked(word)?;
            plan.cones.push(event);
        }
        Ok(plan)
    }

    fn color(&self, row: Option<usize>) -> Ink {
        row.map_or(INK, |row| self.spacetime.lines[row].color)
    }

    fn add_frame(&mut self, frame: &ReferenceFrame) {
        if !self.frames.iter().any(|known| known.name == frame.name) {
            self.frames.push(frame.clone());
        }
    }

    /// An event, which has a mark.
    fn marked(&mut self, word: &EventWord) -> Result<(String, Event), Error> {
        let (name, event) = self.event(word)?;
        self.shows_eye |= *word == EventWord::Eye;
        let is_known =
            *word == EventWord::Eye || self.events.iter().any(|(known, _)| *known == name);
        if !is_known {
            self.events.push((name.clone(), event));
        }
        Ok((name, event))
    }

    /// A frame, an event on its line of simultaneity, and the row of the body it belongs to. The frame
    /// of a body that accelerates is the momentary one at this event, unless an own time is given.
    fn frame_through(
        &mut self,
        word: &FrameWord,
        event: &EventWord,
    ) -> Result<(ReferenceFrame, Event, Option<usize>), Error> {
        let event = match event {
            EventWord::Name(_) | EventWord::Eye => self.marked(event)?.1,
            // The line itself shows where it is.
            _ => self.event(event)?.1,
        };
        let row = match &word.owner {
            FrameOwner::Line(name) => Some(self.spacetime.line(name)?),
            FrameOwner::Camera => Some(self.spacetime.camera_line()),
            FrameOwner::Scene => None,
        };
        let frame = match row {
            Some(row) if word.own_time.is_none() => {
                let line = &self.spacetime.lines[row];
                let is_inertial = line.motion.inertial_frame().is_some();
                let here = || line.motion.at_event(event).map_err(Error::of_line(&line.name));
                match word.owner {
                    FrameOwner::Camera => self.spacetime.camera_frame(),
                    _ if is_inertial => self.spacetime.frame_of(row, None)?,
                    _ => self.spacetime.frame_of(row, Some(here()?.1))?,
                }
            }
            _ => self.spacetime.frame(word)?,
        };
        self.add_frame(&frame);
        Ok((frame, event, row))
    }

    /// An event by its word, and its name.
    fn event(&self, word: &EventWord) -> Result<(String, Event), Error> {
        Ok(match word {
            EventWord::Eye => ("eye".to_owned(), Event::ORIGIN),
            EventWord::Numbers { numbers, frame: of } => {
                let of = self.spacetime.frame(of)?;
                let (time, place) = match numbers[..] {
                    [t, x, y, z] => (t, DVec3::new(x, y, z)),
                    _ => (numbers[0], self.axis * numbers[1]),
                };
                let name = numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
                (format!("({name})"), of.event(Event { t: time, x: place }))
            }
            EventWord::OwnTime { name, own_time } => {
                let line = &self.spacetime.lines[self.spacetime.line(name)?];
                let event = line.motion.event(line.point, *own_time);
                (format!("{name}@{own_time}"), event.map_err(Error::of_line(name))?)
            }
            EventWord::Name(name) => {
                let named = self.events.iter().find(|(known, _)| known == name);
                let light = || self.spacetime.lights.iter().find(|light| light.vertex == *name);
                let event = named.map(|(_, event)| *event).or_else(|| Some(light()?.event));
                (name.clone(), event.ok_or_else(|| Error::UnknownEvent(name.clone()))?)
            }
        })
    }
}
