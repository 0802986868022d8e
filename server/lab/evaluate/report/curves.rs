//! Robustness curves: deliveries and tracking errors over a varied parameter, and deliveries over two as heat maps.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::evaluate::{FigureError, Row};
use ferry_core::scenario::{Kind, Parameter};

const PANEL_PX: (u32, u32) = (560, 360);
const FONT: &str = "sans-serif";
/// Okabe and Ito's colours, which people with any colour vision can tell apart.
const COLORS: [RGBColor; 5] =
    [RGBColor(0, 114, 178), RGBColor(213, 94, 0), RGBColor(0, 158, 115), RGBColor(204, 121, 167), RGBColor(90, 90, 90)];

type DrawingError = DrawingAreaErrorKind<std::io::Error>;
type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// The rows of one map and number of disturbances, over one or two varied parameters.
pub(super) struct Curves<'a> {
    rows: Vec<&'a Row>,
}

/// A varied parameter as an axis: its name with the unit, and its values.
struct Axis {
    label: String,
    scale: f64,
    values: Vec<f64>,
}

impl Axis {
    fn of(rows: &[&Row], index: usize) -> Option<Self> {
        let name = &rows.first()?.varied.get(index)?.name;
        let parameter = Parameter::named(name).ok()?;
        let Kind::Number(number) = parameter.kind else { return None };
        let unit = if number.unit.shown.is_empty() { String::new() } else { format!(", {}", number.unit.shown) };
        let mut values: Vec<f64> = rows.iter().filter_map(|row| Some(row.varied.get(index)?.value)).collect();
        values.sort_by(f64::total_cmp);
        values.dedup();
        Some(Self { label: format!("{}{unit} ({name})", parameter.label), scale: number.unit.scale, values })
    }

    /// A value in the shown unit.
    fn shown(&self, value: f64) -> f64 {
        format!("{:.5e}", value * self.scale).parse().unwrap_or(value)
    }

    fn ends(&self) -> [f64; 2] {
        [self.values[0], self.values[self.values.len() - 1]].map(|value| self.shown(value))
    }
}

/// From near white to the first colour.
fn shade(share: f64) -> RGBColor {
    let RGBColor(red, green, blue) = COLORS[0];
    let mixed = |full: u8| (240.0 + share * (f64::from(full) - 240.0)) as u8;
    RGBColor(mixed(red), mixed(green), mixed(blue))
}

impl<'a> Curves<'a> {
    /// One figure for each map and number of disturbances; none if nothing is varied.
    pub fn all(rows: &'a [Row]) -> Vec<Self> {
        let mut all: Vec<Self> = Vec::new();
        for row in rows.iter().filter(|row| !row.varied.is_empty()) {
            let is_alike = |one: &&mut Self| {
                let first = one.rows[0];
                first.map == row.map && first.disturbances == row.disturbances
            };
            match all.iter_mut().find(is_alike) {
                Some(one) => one.rows.push(row),
                None => all.push(Self { rows: vec![row] }),
            }
        }
        all
    }

    fn controllers(&self) -> Vec<&'a str> {
        let mut names: Vec<&str> = Vec::new();
        for row in &self.rows {
            if !names.contains(&row.controller.as_str()) {
                names.push(&row.controller);
            }
        }
        names
    }

    /// # Errors
    /// [`FigureError`] with the message of the plotting library.
    pub fn to_svg(&self) -> Result<String, FigureError> {
        let (Some(first), second) = (Axis::of(&self.rows, 0), Axis::of(&self.rows, 1)) else {
            return Ok(String::new());
        };
        let panels = second.as_ref().map_or(2, |_| self.controllers().len());
        let size_px = (PANEL_PX.0 * panels.min(2) as u32, PANEL_PX.1 * panels.div_ceil(2) as u32 + 30);
        let mut svg = String::new();
        let root = SVGBackend::with_string(&mut svg, size_px).into_drawing_area();
        let draw = || -> Result<(), DrawingError> {
            root.fill(&WHITE)?;
            let Row { map, disturbances, episodes, .. } = self.rows[0];
            let title = format!("{map}, {disturbances} disturbances, {episodes} trials for each value");
            let panels = root.titled(&title, (FONT, 18))?.split_evenly((panels.div_ceil(2), panels.min(2)));
            match &second {
                None => {
                    let delivered = |row: &Row| {
                        let share = f64::from(row.delivered) / f64::from(row.episodes);
                        Some([share, row.wilson95[0], row.wilson95[1]].map(|share| share * 100.0))
                    };
                    self.lines(&panels[0], "delivered, % (Wilson, 95 %)", &first, Some(100.0), &delivered)?;
                    let error = |row: &Row| {
                        let [low_m, high_m] = row.tracking_error_mean95_m?;
                        Some([row.tracking_error_mean_m, low_m, high_m].map(|error_m| error_m * 1e3))
                    };
                    self.lines(&panels[1], "mean tracking error, mm (Student's t, 95 %)", &first, None, &error)?;
                }
                Some(second) => {
                    for (panel, controller) in panels.iter().zip(self.controllers()) {
                        self.heat(panel, controller, [&first, second])?;
                    }
                }
            }
            root.present()
        };
        draw()?;
        drop(root);
        Ok(svg)
    }

    /// One line per controller, with error bars; `value` gives the middle and both ends.
    fn lines(
        &self,
        area: &Area<'_>,
        caption: &str,
        axis: &Axis,
        most: Option<f64>,
        value: &dyn Fn(&Row) -> Option<[f64; 3]>,
    ) -> Result<(), DrawingError> {
        let [low, high] = axis.ends();
        let air = 0.05 * (high - low);
        let tops = self.rows.iter().filter_map(|row| value(row)).map(|[_, _, top]| top);
        let most = most.unwrap_or_else(|| 1.1 * tops.fold(1.0, f64::max));
        let mut chart = ChartBuilder::on(area)
            .caption(caption, (FONT, 15))
            .margin(10)
            .x_label_area_size(38)
            .y_label_area_size(42)
            .build_cartesian_2d(low - air..high + air, 0.0..most * 1.02)?;
        chart
            .configure_mesh()
            .light_line_style(WHITE)
            .x_desc(&axis.label)
            .label_style((FONT, 12))
            .y_label_formatter(&|value| format!("{value:.0}"))
            .draw()?;
        let names = self.controllers();
        for (index, &name) in names.iter().enumerate() {
            let style = COLORS[index % COLORS.len()].stroke_width(2);
            // Beside each other, so that equal values stay visible.
            let aside = (index as f64 - 0.5 * (names.len() - 1) as f64) * 0.008 * (high - low);
            let mut points: Vec<(f64, [f64; 3])> = self
                .rows
                .iter()
                .filter(|row| row.controller == name)
                .filter_map(|row| Some((axis.shown(row.varied.first()?.value) + aside, value(row)?)))
                .collect();
            points.sort_by(|one, other| one.0.total_cmp(&other.0));
            chart
                .draw_series(LineSeries::new(points.iter().map(|&(x, [middle, ..])| (x, middle)), style))?
                .label(name)
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 16, y)], style));
            let bars = points
                .iter()
                .map(|&(x, [middle, low, high])| ErrorBar::new_vertical(x, low, middle, high, style.filled(), 6));
            chart.draw_series(bars)?;
        }
        let position = SeriesLabelPosition::LowerLeft;
        chart
            .configure_series_labels()
            .position(position)
            .label_font((FONT, 12))
            .background_style(WHITE.mix(0.8))
            .border_style(BLACK.mix(0.2))
            .draw()
    }

    /// Deliveries of one controller over both parameters, the second one to the right.
    fn heat(&self, area: &Area<'_>, controller: &str, [up, right]: [&Axis; 2]) -> Result<(), DrawingError> {
        let (columns, rows) = (right.values.len(), up.values.len());
        let mut chart = ChartBuilder::on(area)
            .caption(format!("{controller}: delivered, %"), (FONT, 15))
            .margin(10)
            .x_label_area_size(38)
            .y_label_area_size(60)
            .build_cartesian_2d((0..columns - 1).into_segmented(), (0..rows - 1).into_segmented())?;
        let text = |axis: &Axis, at: &SegmentValue<usize>| match at {
            SegmentValue::CenterOf(index) => axis.values.get(*index).map(|&value| axis.shown(value).to_string()),
            _ => None,
        };
        chart
            .configure_mesh()
            .disable_mesh()
            .x_desc(&right.label)
            .y_desc(&up.label)
            .x_labels(columns)
            .y_labels(rows)
            .x_label_formatter(&|at| text(right, at).unwrap_or_default())
            .y_label_formatter(&|at| text(up, at).unwrap_or_default())
            .label_style((FONT, 12))
            .draw()?;
        let place = |axis: &Axis, value: f64| axis.values.iter().position(|&one| one == value);
        for row in self.rows.iter().filter(|row| row.controller == controller) {
            let [one, other] = row.varied.as_slice() else { continue };
            let (Some(x), Some(y)) = (place(right, other.value), place(up, one.value)) else { continue };
            let share = f64::from(row.delivered) / f64::from(row.episodes);
            let corners = [
                (SegmentValue::Exact(x), SegmentValue::Exact(y)),
                (SegmentValue::Exact(x + 1), SegmentValue::Exact(y + 1)),
            ];
            chart.draw_series(
                [shade(share).filled(), WHITE.stroke_width(1)].map(|style| Rectangle::new(corners.clone(), style)),
            )?;
            let ink = if share > 0.6 { WHITE } else { BLACK };
            let style = TextStyle::from((FONT, 13)).color(&ink);
            let style = style.pos(plotters::style::text_anchor::Pos::new(
                plotters::style::text_anchor::HPos::Center,
                plotters::style::text_anchor::VPos::Center,
            ));
            let center = (SegmentValue::CenterOf(x), SegmentValue::CenterOf(y));
            chart.draw_series([Text::new(format!("{:.0}", share * 100.0), center, style)])?;
        }
        Ok(())
    }
}
