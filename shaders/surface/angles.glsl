// The angles at a point (shaders/models/lobes.glsl), from vectors that point away from it.

// A cosine as models want it: 0 behind the surface, and not above 1 by rounding.
Real cosine(Real value) {
    return min(max(value, Real(0)), Real(1));
}

// The tangent, or `across` where the tangent is within 3° of the normal and would have no steady
// direction in the surface: at the poles of a ball, or all over a face that the x axis pierces.
Vec3 steady_tangent(Vec3 normal, Vec3 tangent, Vec3 across) {
    Real along = dot(normal, tangent);
    return select(along * along > Real(0.9973) * dot(tangent, tangent) * dot(normal, normal), across,
                  tangent);
}

// C of E[2.2-29]: the cosine between L and V projected on the surface; j = N·L, k = N·V.
Real azimuth_between(Vec3 normal, Vec3 to_light, Vec3 to_viewer, Real j, Real k) {
    Vec3 light = to_light - normal * j;
    Vec3 viewer = to_viewer - normal * k;
    Real across = sqrt(dot(light, light) * dot(viewer, viewer));
    Real ratio = dot(light, viewer) / across;
    return select(across > Real(0), min(max(ratio, Real(-1)), Real(1)), Real(0));
}

// The squared cosine between T and H projected on the surface, as both lose their part along the
// normal; 1 where either has no other part. h = N·H.
Real tangent_between(Vec3 normal, Vec3 tangent, Vec3 bisector, Real h) {
    Vec3 projected = bisector - normal * h;
    Vec3 flat_tangent = tangent - normal * dot(normal, tangent);
    Real size = dot(projected, projected) * dot(flat_tangent, flat_tangent);
    Real along = dot(projected, flat_tangent);
    return select(size > Real(0), min(along * along / size, Real(1)), Real(1));
}

// The angles of unit vectors; `tangent` need be neither unit nor orthogonal to the normal. The two that
// cost something are left at 0 and 1 where no model of the scene needs them.
Angles angles_of(Vec3 normal, Vec3 tangent, Vec3 to_light, Vec3 to_viewer, Real solid_angle,
                 bool needs_azimuth, bool needs_tangent) {
    Vec3 bisector = unit(to_light + to_viewer);
    Real j = dot(normal, to_light);
    Real k = dot(normal, to_viewer);
    Real h = dot(normal, bisector);
    Angles angles;
    angles.n_dot_l = cosine(j);
    angles.n_dot_v = cosine(k);
    angles.n_dot_h = cosine(h);
    angles.v_dot_h = cosine(dot(to_viewer, bisector));
    angles.r_dot_v = cosine(Real(2) * j * k - dot(to_light, to_viewer));
    angles.azimuth = Real(0);
    angles.tangent = Real(1);
    angles.solid_angle = solid_angle;
    if (needs_azimuth) angles.azimuth = azimuth_between(normal, to_light, to_viewer, j, k);
    if (needs_tangent) angles.tangent = tangent_between(normal, tangent, bisector, h);
    return angles;
}
