// M. Pharr, W. Jakob and G. Humphreys, "Physically Based Rendering", 4th edition, 2023, 12.2.2: a point
// light that shines into a cone with a smooth edge. θ is the angle from the axis, θo the half-angle of
// the cone, θi that within which the light is at its full:
//
//     weight = (d₀/d)² t² (3 − 2t),   t = (cos θ − cos θo) / (cos θi − cos θo), cut to 0..1
//
// The penumbra e is the share of the cone's solid angle in which the light fades, so that
// cos θi = cos θo + e (1 − cos θo). Angles come as v = 1 − cos, and that of θ is ½|D + L|² of the unit
// vectors D along the axis and L to the light: the cosine of a narrow cone would have lost its digits.
// Then t = (vo − v) / (e vo); at e = 0 the edge is a step, and a point on it is outside.
Incident spot_light(Vec3 at, SpotLight light) {
    Incident incident = from_place(at, light.position, light.reference_squared);
    Vec3 off_axis = incident.direction + light.direction;
    Real inside = light.half_angle_versine - Real(0.5) * dot(off_axis, off_axis);
    Real width = max(light.penumbra * light.half_angle_versine, Real(1e-30));
    Real t = min(max(inside / width, Real(0)), Real(1));
    incident.weight = incident.weight * (t * t * (Real(3) - Real(2) * t));
    return incident;
}
