// No paper: a point light that shines ahead of itself alone, as far as an angle from its axis whose cosine
// is `edge`.
Incident toy_light(Vec3 at, ToyLight light) {
    Incident incident = from_place(at, light.position, light.reference_squared);
    Real cosine = dot(incident.direction * Real(-1), light.direction);
    incident.weight = select(cosine > light.edge, incident.weight, Real(0));
    return incident;
}
