// The angles at a point, as server/cpu/angles.h has them.

float cosine(float value) { return min(max(value, 0.0), 1.0); }

// The tangent, or `across` where the tangent is within 3° of the normal.
vec3 steady_tangent(vec3 normal, vec3 tangent, vec3 across) {
    float along = dot(normal, tangent);
    return along * along > 0.9973 * dot(tangent, tangent) * dot(normal, normal) ? across : tangent;
}

Angles angles_of(vec3 normal, vec3 tangent, vec3 to_light, vec3 to_viewer, float solid_angle) {
    vec3 bisector = unit(to_light + to_viewer);
    float j = dot(normal, to_light), k = dot(normal, to_viewer), h = dot(normal, bisector);
    Angles angles;
    angles.n_dot_l = cosine(j);
    angles.n_dot_v = cosine(k);
    angles.n_dot_h = cosine(h);
    angles.v_dot_h = cosine(dot(to_viewer, bisector));
    angles.r_dot_v = cosine(2.0 * j * k - dot(to_light, to_viewer));
    vec3 light = to_light - normal * j, viewer = to_viewer - normal * k;
    float around = sqrt(dot(light, light) * dot(viewer, viewer));
    angles.azimuth = around > 0.0 ? clamp(dot(light, viewer) / around, -1.0, 1.0) : 0.0;
    // Compare in the surface's plane; both T and H lose their part along the normal.
    vec3 projected = bisector - normal * h;
    vec3 level = tangent - normal * dot(normal, tangent);
    float size = dot(projected, projected) * dot(level, level);
    float along = dot(projected, level);
    angles.tangent = size > 0.0 ? min(along * along / size, 1.0) : 1.0;
    angles.solid_angle = solid_angle;
    return angles;
}
