// How far a point is lifted off its surface before it looks for lights or mirrors: what f32 may have got
// wrong of a place that a ray has found after `distance`, and a little more.
Real lift_off(Vec3 point, Real distance) {
    Real size = max(max(abs(point.x), abs(point.y)), max(abs(point.z), distance));
    return size * Real(1e-5);
}
