//! The terms of a cuboid's field at several points together, one point per vector lane.
//!
//! The tensor T of the field is a sum over edges and faces, as for any polyhedron (Werner and Scheeres,
//! Celest. Mech. Dyn. Astron. 65, 313 (1996)). Let L be an edge's length, r₁ and r₂ its ends relative to
//! the point, N = R₁ + R₂ the sum of their distances and S = R₁R₂ + r₁·r₂, which is (N² − L²)/2. Then
//! - an edge along z adds ± ln((N + L)/(N − L)) = ± ln((N + L)²/2S) to T_xy;
//! - a face normal to x, at the distance X, adds ± its solid angle to T_xx. Half of that is the sum of
//!   arg(S + X·N + i·D·L) over the face's edges, with D the distance of the point's foot from the edge's
//!   line, negative on the line's outer side (Van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30,
//!   125 (1983)).
//!
//! So each entry of T takes one logarithm of a product, or one complex argument of a product: outside, the
//! half angles add up to less than half a turn.
//!
//! Lengths are in half-diagonals, and points are mirrored to x, y, z ≥ 0. `axis` is always a literal and
//! all functions are inlined, so that indices are constants: with run-time indices it takes four times as long.

use crate::geometry::Vector3;
use std::f64::consts::PI;
use wide::f64x2;

pub(super) type Lanes = f64x2;
/// Points per call: as many as fit a register of any x86-64. Four are no faster.
pub(super) const LANES: usize = 2;

/// On an edge the field is infinite. Points nearer to it than this share of the half-diagonal (some tens of
/// picometres, sharper than any real edge) are evaluated at this distance.
const EDGE_RADIUS: f64 = 1e-9;

/// The tensor T: of B outside the cuboid, of H inside.
pub(super) struct Tensor {
    /// T_xx, T_yy, T_zz.
    pub(super) diagonal: [Lanes; 3],
    /// T_yz, T_zx, T_xy.
    pub(super) mixed: [Lanes; 3],
}

/// The derivatives of T, except those that follow because the potential is harmonic.
pub(super) struct Slopes {
    /// ∂T_yz/∂x.
    pub(super) xyz: Lanes,
    /// ∂T_yz/∂y, ∂T_zx/∂z, ∂T_xy/∂x.
    pub(super) next: [Lanes; 3],
    /// ∂T_yz/∂z, ∂T_zx/∂x, ∂T_xy/∂y.
    pub(super) last: [Lanes; 3],
}

/// The cuboid relative to the points.
pub(super) struct View {
    /// X, Y, Z: by axis, the position relative to the upper (0) and to the lower (1) face.
    offset: [[Lanes; 2]; 3],
    /// Squares of `offset`.
    square: [[Lanes; 2]; 3],
    /// Distance of each corner, by its face along x, y and z.
    distance: [[[Lanes; 2]; 2]; 2],
    /// Length of the edges along each axis.
    length: [Lanes; 3],
    /// Whether the point lies between the faces normal to each axis.
    is_between: [Lanes; 3],
}

/// An edge relative to the points.
struct Edge {
    /// N.
    sum: Lanes,
    /// R₁R₂.
    product: Lanes,
    /// S, never zero.
    scalar: Lanes,
}

/// The edges along an axis, by their face along the next axis and the one after it.
type Edges = [[Edge; 2]; 2];

/// Real and imaginary part.
type Complex = (Lanes, Lanes);

impl View {
    /// For a cuboid of half sides `half` and `points` by coordinate, none of them negative.
    #[inline(always)]
    pub(super) fn new(half: &Vector3<f64>, points: [Lanes; 3]) -> Self {
        let half = [Lanes::splat(half.x), Lanes::splat(half.y), Lanes::splat(half.z)];
        let offset = [
            [points[0] - half[0], points[0] + half[0]],
            [points[1] - half[1], points[1] + half[1]],
            [points[2] - half[2], points[2] + half[2]],
        ];
        let square = offset.map(|[upper, lower]| [upper * upper, lower * lower]);
        let [[x1, x2], y, z] = square;
        Self {
            offset,
            square,
            distance: [distances(x1, y, z), distances(x2, y, z)],
            length: half.map(|h| h + h),
            is_between: [points[0].simd_lt(half[0]), points[1].simd_lt(half[1]), points[2].simd_lt(half[2])],
        }
    }

    /// All bits set if the point lies inside; a face belongs to the outside.
    #[inline(always)]
    pub(super) fn is_inside(&self) -> Lanes {
        self.is_between[0] & self.is_between[1] & self.is_between[2]
    }

    /// The entries of T that T·J needs if only `axes` of J are not zero; the others are zero.
    #[inline(always)]
    pub(super) fn tensor(&self, axes: [bool; 3]) -> Tensor {
        let [x, y, z] = [self.edges(0), self.edges(1), self.edges(2)];
        // Arithmetic first: logarithms and arctangents branch, and values that live across a branch go through memory.
        let ratios = [self.ratio(0, &x), self.ratio(1, &y), self.ratio(2, &z)];
        let is_trace_enough = axes[0] && axes[1];
        let faces = [
            if axes[0] { self.faces(0, &y, &z) } else { Faces::NONE },
            if axes[1] { self.faces(1, &z, &x) } else { Faces::NONE },
            if axes[2] && !is_trace_enough { self.faces(2, &x, &y) } else { Faces::NONE },
        ];
        let mixed = [
            if axes[1] || axes[2] { ratios[0].ln() } else { Lanes::ZERO },
            if axes[2] || axes[0] { ratios[1].ln() } else { Lanes::ZERO },
            if axes[0] || axes[1] { ratios[2].ln() } else { Lanes::ZERO },
        ];
        let xx = if axes[0] { faces[0].angle() } else { Lanes::ZERO };
        let yy = if axes[1] { faces[1].angle() } else { Lanes::ZERO };
        let zz = if is_trace_enough {
            // Seen from inside, the six faces cover the full solid angle; from outside they cancel.
            (self.is_inside() & Lanes::splat(-4.0 * PI)) - xx - yy
        } else if axes[2] {
            faces[2].angle()
        } else {
            Lanes::ZERO
        };
        Tensor { diagonal: [xx, yy, zz], mixed }
    }

    /// All derivatives.
    #[inline(always)]
    pub(super) fn slopes(&self) -> Slopes {
        let [x, y, z] = [self.edges(0), self.edges(1), self.edges(2)];
        let (yyz, yzz) = self.slopes_across(0, &x);
        let (zzx, zxx) = self.slopes_across(1, &y);
        let (xxy, xyy) = self.slopes_across(2, &z);
        Slopes { xyz: self.slope_along(2, &z), next: [yyz, zzx, xxy], last: [yzz, zxx, xyy] }
    }

    #[inline(always)]
    fn edges(&self, axis: usize) -> Edges {
        [[self.edge(axis, 0, 0), self.edge(axis, 0, 1)], [self.edge(axis, 1, 0), self.edge(axis, 1, 1)]]
    }

    #[inline(always)]
    fn edge(&self, axis: usize, i: usize, j: usize) -> Edge {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut corner = [0; 3];
        (corner[u], corner[v]) = (i, j);
        let upper = self.distance[corner[0]][corner[1]][corner[2]];
        corner[axis] = 1;
        let lower = self.distance[corner[0]][corner[1]][corner[2]];
        let product = upper * lower;
        // Squared distance from the edge's line.
        let aside = (self.square[u][i] + self.square[v][j]).fast_max(Lanes::splat(EDGE_RADIUS * EDGE_RADIUS));
        let dot = self.offset[axis][0] * self.offset[axis][1] + aside;
        // Beside the edge R₁R₂ + r₁·r₂ cancels; the equal |r₁ × r₂|²/(R₁R₂ − r₁·r₂) does not.
        let larger = product + dot.abs();
        let cross = aside * (self.length[axis] * self.length[axis]);
        let scalar = dot.simd_lt(Lanes::ZERO).select(cross / larger, larger);
        Edge { sum: upper + lower, product, scalar }
    }

    /// The number whose logarithm is T_yz, for `axis` x.
    #[inline(always)]
    fn ratio(&self, axis: usize, edges: &Edges) -> Lanes {
        let length = self.length[axis];
        let [[a, b], [c, d]] = edges;
        let above = (a.sum + length) * (d.sum + length);
        let below = (b.sum + length) * (c.sum + length);
        (above * above * (b.scalar * c.scalar)) / (below * below * (a.scalar * d.scalar))
    }

    /// The two faces normal to `axis`, from the edges along the next axis and the one after it.
    #[inline(always)]
    fn faces(&self, axis: usize, next: &Edges, last: &Edges) -> Faces {
        let near = self.face(axis, 0, next, last);
        let far = self.face(axis, 1, next, last);
        // From between the faces both count against the axis, from outside only the farther one.
        let is_between = self.is_between[axis];
        let (cosine, sine) = times(near, (far.0, far.1.flip_signs(!is_between)));
        // Inside, the two may add up to more than half a turn, but only if the nearer face alone has more
        // than a quarter: then the product is rotated back by half a turn.
        let is_turned = self.is_inside() & near.0.simd_lt(Lanes::ZERO);
        Faces {
            cosine: cosine.flip_signs(is_turned),
            sine: sine.flip_signs(is_turned),
            turn: is_turned & Lanes::splat(PI),
            is_between,
        }
    }

    /// A number whose argument is half the solid angle of a face.
    #[inline(always)]
    fn face(&self, axis: usize, side: usize, next: &Edges, last: &Edges) -> Complex {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let height = self.offset[axis][side].abs();
        let factor = |edge: &Edge, inward: Lanes| (edge.scalar + height * edge.sum, inward);
        let [a, b] = [self.offset[v][0] * self.length[u], self.offset[v][1] * self.length[u]];
        let [c, d] = [self.offset[u][0] * self.length[v], self.offset[u][1] * self.length[v]];
        times(
            times(factor(&next[0][side], -a), factor(&next[1][side], b)),
            times(factor(&last[side][0], -c), factor(&last[side][1], d)),
        )
    }

    /// ∂T_yz/∂y and ∂T_yz/∂z for `axis` x.
    #[inline(always)]
    fn slopes_across(&self, axis: usize, edges: &Edges) -> (Lanes, Lanes) {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        // ∂ ln((N + L)/(N − L)) = −(L/S)·∂N, and ∂N/∂y = Y·N/(R₁R₂).
        let slope = |edge: &Edge| edge.sum / (edge.product * edge.scalar);
        let [[a, b], [c, d]] = edges;
        let [[a, b], [c, d]] = [[slope(a), slope(b)], [slope(c), slope(d)]];
        let next = self.offset[u][0] * (b - a) + self.offset[u][1] * (c - d);
        let last = self.offset[v][0] * (c - a) + self.offset[v][1] * (b - d);
        (next * self.length[axis], last * self.length[axis])
    }

    /// ∂T_yz/∂x for `axis` x.
    #[inline(always)]
    fn slope_along(&self, axis: usize, edges: &Edges) -> Lanes {
        // 1/R₁ − 1/R₂ in a form without cancellation.
        let inverse = |edge: &Edge| Lanes::ONE / (edge.sum * edge.product);
        let [[a, b], [c, d]] = edges;
        let [upper, lower] = self.square[axis];
        (inverse(b) + inverse(c) - inverse(a) - inverse(d)) * (lower - upper)
    }
}

/// Two opposite faces; their solid angles make up an entry of T.
struct Faces {
    /// Real part of a number whose argument is half that entry.
    cosine: Lanes,
    /// Its imaginary part.
    sine: Lanes,
    /// Offset added to the argument.
    turn: Lanes,
    /// Whether the argument counts against the axis.
    is_between: Lanes,
}

impl Faces {
    const NONE: Self = Self { cosine: Lanes::ONE, sine: Lanes::ZERO, turn: Lanes::ZERO, is_between: Lanes::ZERO };

    /// The entry of T, from the argument of the number, rad.
    #[inline(always)]
    fn angle(&self) -> Lanes {
        let half = self.sine.atan2(self.cosine) + self.turn;
        (half + half).flip_signs(self.is_between)
    }
}

#[inline(always)]
fn distances(x: Lanes, y: [Lanes; 2], z: [Lanes; 2]) -> [[Lanes; 2]; 2] {
    let distance = |y: Lanes, z: Lanes| (x + y + z).sqrt().fast_max(Lanes::splat(EDGE_RADIUS));
    [[distance(y[0], z[0]), distance(y[0], z[1])], [distance(y[1], z[0]), distance(y[1], z[1])]]
}

/// The product of two complex numbers.
#[inline(always)]
fn times(a: Complex, b: Complex) -> Complex {
    (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)
}
