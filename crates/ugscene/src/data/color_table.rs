//! Colours that change with the own time of their body.

use super::ids::ColorId;

/// A colour made of others over own time: `c_time`. The statement of the colour itself in
/// [`crate::Scene::colors`] is that at own time 0, for programs that show no times.
#[derive(Clone, Debug, PartialEq)]
pub struct ColorTable {
    /// The colour.
    pub color: ColorId,
    /// One row or more: own times, increasing, and colours, which do not change themselves.
    pub rows: Vec<(f64, ColorId)>,
    /// Each colour lasts until the next row. If not, light is interpolated linearly between rows.
    pub is_stepped: bool,
    /// The rows repeat after this time, which is longer than from the first to the last of them; if
    /// not, the first and the last colour last for ever.
    pub period: Option<f64>,
    /// Is added to all times of rows. It is separate from them, because rows that are close
    /// together would become one if it were large.
    pub shift: f64,
}

/// A place in a [`ColorTable`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TablePlace {
    /// The number of the repetition; 0 without a period.
    pub cycle: f64,
    /// The last row at or before the time; −1 before the first one.
    pub row: i64,
    /// The colours in effect, with their shares, which add up to 1. The second has no share where
    /// one colour is in effect.
    pub parts: [(ColorId, f64); 2],
}

impl ColorTable {
    /// The colours in effect at an own time.
    pub fn at(&self, own_time: f64) -> TablePlace {
        let own_time = own_time - self.shift;
        let [(first, first_color), .., (last, last_color)] = self.rows[..] else {
            let color = self.rows.first().map_or(self.color, |row| row.1);
            return TablePlace { cycle: 0.0, row: 0, parts: [(color, 1.0), (color, 0.0)] };
        };
        let (cycle, time) = match self.period {
            Some(period) => {
                let cycle = ((own_time - first) / period).floor();
                (cycle, first + (own_time - first).rem_euclid(period))
            }
            None => (0.0, own_time),
        };
        let after = self.rows.partition_point(|row| row.0 <= time);
        // Repeated, the last row is followed by the first one.
        let again = self.period.map(|period| (first + period, first_color));
        let before = after.checked_sub(1).map_or((first, first_color), |row| self.rows[row]);
        let next = self.rows.get(after).copied().or(again).unwrap_or((last, last_color));
        let share = if self.is_stepped || before.1 == next.1 || next.0 <= before.0 {
            0.0
        } else {
            ((time - before.0) / (next.0 - before.0)).clamp(0.0, 1.0)
        };
        TablePlace {
            cycle,
            row: after as i64 - 1,
            parts: [(before.1, 1.0 - share), (next.1, share)],
        }
    }

    /// The same table for times that count from `zero`.
    pub fn counted_from(&self, zero: f64) -> Self {
        Self { shift: self.shift - zero, ..self.clone() }
    }
}
