//! The learning curve, as data and as the paper's figure (paper, Figure 5: mean and standard deviation of reward and
//! loss over the rounds of training).

use std::fmt::Write;

use plotters::prelude::*;

use super::point::{Point, Spread};

/// The curve of one run, with the time of each point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    pub points: Vec<Point>,
    /// Seconds of the run at each of the last points; the points before a resume have no time.
    times_s: Vec<f64>,
    /// Seconds of the run before it was resumed.
    before_s: f64,
}

#[derive(Debug, thiserror::Error)]
#[error("figure: {0}")]
pub struct FigureError(String);

const SIZE_PX: (u32, u32) = (760, 560);

impl Curve {
    /// The curve of a resumed run that had taken `before_s` seconds.
    pub fn resumed(before_s: f64) -> Self {
        Self { before_s, ..Self::default() }
    }

    /// Records the time of a new point, in seconds since the run began or was resumed.
    pub fn time(&mut self, elapsed_s: f64) {
        self.times_s.push(self.before_s + elapsed_s);
    }

    /// Total seconds of the run.
    pub fn spent_s(&self) -> f64 {
        self.times_s.last().copied().unwrap_or(self.before_s)
    }

    /// One line per point. `ARCHITECTURE.md` describes the columns.
    pub fn csv(&self) -> String {
        let mut text = String::from(
            "update,steps,episodes,elapsed_s,reward_mean,reward_deviation,loss_mean,loss_deviation,gradient_mean,\
             reached,collided,ended,examined_reached,examined_episodes\n",
        );
        let untimed = self.points.len() - self.times_s.len().min(self.points.len());
        for (index, point) in self.points.iter().enumerate() {
            let number = |value: Option<f64>| value.map(|value| format!("{value:.6}")).unwrap_or_default();
            let time = index.checked_sub(untimed).map(|index| self.times_s[index]);
            let examined = point.examined.map_or((String::new(), String::new()), |marks| {
                (marks.reached.to_string(), marks.episodes.to_string())
            });
            writeln!(
                text,
                "{},{},{},{},{},{},{},{},{},{},{},{},{},{}",
                point.update,
                point.steps,
                point.episodes,
                time.map(|time_s| format!("{time_s:.1}")).unwrap_or_default(),
                number(point.reward.mean()),
                number(point.reward.deviation()),
                number(point.loss.mean()),
                number(point.loss.deviation()),
                number(point.gradient.mean()),
                point.reached,
                point.collided,
                point.reward.count(),
                examined.0,
                examined.1,
            )
            .expect("writing to a string does not fail");
        }
        text
    }

    /// Mean and deviation over runs as SVG: episode rewards in the upper plot, losses in the lower one.
    ///
    /// # Errors
    /// [`FigureError`] if the drawing fails.
    pub fn figure(curves: &[Self]) -> Result<String, FigureError> {
        let mut text = String::new();
        draw(curves, &mut text).map_err(|error| FigureError(error.to_string()))?;
        Ok(text)
    }
}

/// A line with a band over the episodes, as in the paper's figure: mean number of episodes, mean, deviation.
fn band(curves: &[Curve], get: impl Fn(&Point) -> Spread) -> Vec<(f64, f64, f64)> {
    let count = curves.iter().map(|curve| curve.points.len()).min().unwrap_or(0);
    let at = |index: usize| {
        let values: Vec<f64> = curves.iter().filter_map(|curve| get(&curve.points[index]).mean()).collect();
        let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
        let variance = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / values.len().max(1) as f64;
        // A single round has no deviation between rounds: the deviation between its episodes is shown.
        let deviation = match curves {
            [only] => get(&only.points[index]).deviation().unwrap_or(0.0),
            _ => variance.sqrt(),
        };
        let episodes: u64 = curves.iter().map(|curve| curve.points[index].episodes).sum();
        (!values.is_empty()).then(|| (episodes as f64 / curves.len() as f64, mean, deviation))
    };
    (0..count).filter_map(at).collect()
}

fn draw(curves: &[Curve], text: &mut String) -> Result<(), Box<dyn std::error::Error>> {
    let root = SVGBackend::with_string(text, SIZE_PX).into_drawing_area();
    root.fill(&WHITE)?;
    let panels = root.split_evenly((2, 1));
    let rounds = match curves.len() {
        1 => "one round".to_owned(),
        count => format!("{count} rounds"),
    };
    let spread = if curves.len() == 1 { "between episodes or updates" } else { "between rounds" };
    let lines = [
        ("Reward of an episode", band(curves, |point| point.reward), RGBColor(31, 119, 180)),
        ("Loss", band(curves, |point| point.loss), RGBColor(214, 39, 40)),
    ];
    for (panel, (title, line, color)) in panels.iter().zip(lines) {
        let max_x = line.last().map_or(1.0, |&(x, _, _)| x);
        let low = line.iter().map(|&(_, mean, deviation)| mean - deviation).fold(f64::INFINITY, f64::min);
        let high = line.iter().map(|&(_, mean, deviation)| mean + deviation).fold(f64::NEG_INFINITY, f64::max);
        let (low, high) = if low < high { (low, high) } else { (0.0, 1.0) };
        let margin = 0.05 * (high - low);
        let mut chart = ChartBuilder::on(panel)
            .margin(10)
            .margin_right(30)
            .caption(format!("{title}: mean and deviation {spread}, {rounds}"), ("sans-serif", 16))
            .x_label_area_size(32)
            .y_label_area_size(56)
            .build_cartesian_2d(0.0..max_x, low - margin..high + margin)?;
        let whole = |episodes: &f64| format!("{episodes:.0}");
        let mut mesh = chart.configure_mesh();
        mesh.light_line_style(WHITE).x_label_formatter(&whole).x_desc("episodes").y_desc(title).draw()?;
        let upper = line.iter().map(|&(x, mean, deviation)| (x, mean + deviation));
        let lower = line.iter().rev().map(|&(x, mean, deviation)| (x, mean - deviation));
        chart.draw_series(std::iter::once(Polygon::new(upper.chain(lower).collect::<Vec<_>>(), color.mix(0.25))))?;
        chart.draw_series(LineSeries::new(line.iter().map(|&(x, mean, _)| (x, mean)), color.stroke_width(2)))?;
    }
    root.present()?;
    drop(panels);
    drop(root);
    Ok(())
}

#[cfg(test)]
mod tests {
    use usvg::roxmltree::Document;

    use super::*;
    use crate::learn::Marks;

    fn curve(seed: u64) -> Curve {
        let spread = |first: f64| {
            let mut spread = Spread::default();
            (0..3).for_each(|index| spread.add(first + f64::from(index)));
            spread
        };
        let point = |index: u64| Point {
            update: 100 * index,
            steps: 1600 * index,
            episodes: 3 * index,
            reward: if index == 2 { Spread::default() } else { spread((seed + index) as f64 * 0.1) },
            loss: spread(1.0 / (seed + index) as f64),
            gradient: spread(2.0),
            reached: 2,
            collided: 1,
            examined: (index == 4).then_some(Marks { episodes: 200, reached: 150, ..Marks::default() }),
        };
        let mut curve = Curve { points: (1..=4).map(point).collect(), ..Curve::resumed(20.0) };
        // Resumed after the second point.
        curve.time(5.0);
        curve.time(10.0);
        curve
    }

    #[test]
    fn the_table_has_one_line_per_point_and_one_name_per_column() {
        let curve = curve(1);
        let text = curve.csv();
        let lines: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
        assert_eq!(lines.len(), 1 + curve.points.len());
        assert!(lines.iter().all(|line| line.len() == lines[0].len()), "{text}");
        let column = |name: &str| {
            let index = lines[0].iter().position(|&found| found == name).unwrap();
            lines[1..].iter().map(|line| line[index]).collect::<Vec<_>>()
        };
        assert_eq!(column("update"), ["100", "200", "300", "400"]);
        assert_eq!(column("elapsed_s"), ["", "", "25.0", "30.0"]);
        assert_eq!(column("reward_mean"), ["1.200000", "", "1.400000", "1.500000"], "empty without episodes");
        assert_eq!(column("reward_deviation")[0], "0.816497", "for three numbers with a spacing of 1");
        assert_eq!(column("ended"), ["3", "0", "3", "3"]);
        assert_eq!(column("examined_reached"), ["", "", "", "150"]);
        assert_eq!(column("examined_episodes"), ["", "", "", "200"]);
        assert_eq!(Curve::default().csv().lines().count(), 1);
        assert_eq!((curve.spent_s(), Curve::resumed(20.0).spent_s()), (30.0, 20.0));
    }

    #[test]
    fn the_figure_is_an_image_with_both_titles() {
        for (curves, rounds) in
            [(vec![curve(1)], "one round"), ((1..4).map(curve).collect(), "3 rounds"), (vec![], "0 rounds")]
        {
            let svg = Curve::figure(&curves).unwrap();
            let size = usvg::Tree::from_str(&svg, &usvg::Options::default()).unwrap().size();
            assert_eq!((size.width(), size.height()), (SIZE_PX.0 as f32, SIZE_PX.1 as f32));
            let document = Document::parse(&svg).unwrap();
            let texts: Vec<&str> = document.descendants().filter_map(|node| node.text().map(str::trim)).collect();
            for title in ["Reward of an episode", "Loss"] {
                let is_title = |text: &&str| text.starts_with(&format!("{title}: ")) && text.ends_with(rounds);
                assert!(texts.iter().any(is_title), "{title} {texts:?}");
            }
            assert!(!svg.contains("NaN") && !svg.contains("inf"));
            let bands = document.descendants().filter(|node| node.tag_name().name() == "polygon").count();
            assert!(curves.is_empty() || bands == 2, "{bands}");
        }
    }
}
