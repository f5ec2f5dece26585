flat in uint sphere;  // its object
layout(location = 0) out uint seen;

void main() {
    vec3 direction = sample_direction(uvec2(gl_FragCoord.xy));
    SphereRay ray = sphere_ray(sphere, eye, direction);
    if (ray.half_chord < 0.0) discard;
    // From inside, the far side is what is seen.
    float at = ray.at - ray.half_chord;
    at = at > 0.0 ? at : ray.at + ray.half_chord;
    if (!(at > 0.0)) discard;
    gl_FragDepth = near / (at * dot(direction, forward));
    seen = (first_sphere | sphere) + 1u;
}
