// The angles at a point (shaders/models/lobes.glsl), from vectors that point away from it.
//
// Near a peak two vectors are almost the same, and 1 less their dot product is rounding alone. Angles come
// from what is small itself, which f32 has with all its digits, by W. Kahan, "How futile are mindless
// assessments of roundoff in floating-point computation?", 2006, § 12: the difference of two vectors of
// length 1, and what is left of one without its part along the other. How much the vectors miss the
// length 1 counts squared.

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

// 1 − a·b, at most 1; the half-angle form |a − b|²/2.
Real versine_between(Vec3 a, Vec3 b) {
    Vec3 apart = a - b;
    return min(Real(0.5) * dot(apart, apart), Real(1));
}

// C of E[2.2-29]: the cosine between L and V projected on the surface; j = N·L, k = N·V.
Real azimuth_between(Vec3 normal, Vec3 to_light, Vec3 to_viewer, Real j, Real k) {
    Vec3 light = to_light - normal * j;
    Vec3 viewer = to_viewer - normal * k;
    Real across = sqrt(dot(light, light) * dot(viewer, viewer));
    Real ratio = dot(light, viewer) / across;
    return select(across > Real(0), min(max(ratio, Real(-1)), Real(1)), Real(0));
}

// The angles of unit vectors; `tangent` need be neither unit nor orthogonal to the normal. The azimuth and
// the tangent, which cost something, are left at 0 and 1 where no model of the scene needs them.
Angles angles_of(Vec3 normal, Vec3 tangent, Vec3 to_light, Vec3 to_viewer, Real solid_angle,
                 bool needs_azimuth, bool needs_tangent) {
    // S = L + V and D = L − V are orthogonal where L and V are equally long. They are so but for a
    // rounding, which would count at grazing incidence, where S is short: make them so.
    Vec3 sum = to_light + to_viewer;
    Vec3 apart = to_light - to_viewer;
    Real longer = Real(0.25) * dot(sum, apart);
    sum = sum - apart * longer;

    // H is S/|S|; its part in the surface, times |S|, is `projected`. V·H = |S|/2 is the cosine of half the
    // angle between L and V.
    Real squared = dot(sum, sum);
    Real size = sqrt(squared);
    Real along = dot(normal, sum);
    Vec3 projected = sum - normal * along;
    Real projected_squared = dot(projected, projected);
    Real h = select(squared > Real(0), along / size, Real(0));
    Real h_sine2 = projected_squared / squared;

    // R − V = N (N·D) − projected.
    Real lifted = dot(normal, apart) - longer * along;
    Real r_v_versine = min(Real(0.5) * (projected_squared + lifted * lifted), Real(1));

    Real j = dot(normal, to_light);
    Real k = dot(normal, to_viewer);
    Angles angles;
    angles.n_dot_l = cosine(j);
    angles.n_dot_v = cosine(k);
    angles.n_dot_h = cosine(h);
    angles.v_dot_h = cosine(Real(0.5) * size);
    angles.r_dot_v = Real(1) - r_v_versine;
    angles.n_l_versine = versine_between(normal, to_light);
    angles.n_v_versine = versine_between(normal, to_viewer);
    angles.n_h_versine = select(h > Real(0), min(h_sine2 / (Real(1) + h), Real(1)), Real(1));
    angles.r_v_versine = r_v_versine;
    angles.azimuth = Real(0);
    angles.tangent = Real(1);
    angles.bitangent = Real(0);
    angles.solid_angle = solid_angle;
    if (needs_azimuth) angles.azimuth = azimuth_between(normal, to_light, to_viewer, j, k);
    if (needs_tangent) {
        // The part of `projected` along T, which is projected too, and what is left of it across T.
        Vec3 flat_tangent = tangent - normal * dot(normal, tangent);
        Real tangent_squared = dot(flat_tangent, flat_tangent);
        Real t = dot(projected, flat_tangent);
        Vec3 rest = projected - flat_tangent * (t / tangent_squared);
        Real whole = tangent_squared * projected_squared;
        angles.tangent = select(whole > Real(0), min(t * t / whole, Real(1)), Real(1));
        angles.bitangent =
            select(whole > Real(0), min(dot(rest, rest) / projected_squared, Real(1)), Real(0));
    }
    return angles;
}
