// What a light sends to a point: what shaders/lights/* give. See shaders/README.md for the rules.
struct Incident {
    Vec3 direction;  // to the light, unit
    Real reach;      // of a shadow ray: it ends a little before the light, so that a surface in which
                     // the light lies does not hide it
    Real weight;     // of the light's luminance
};

// Closer to a light than f32 can say, its weight is infinite: such a point has no colour.
Bool is_finite(Incident light) {
    return light.weight <= Real(3.4028235e38);
}

// Light that comes from a place: it falls off with the square of the distance d from it,
//     weight = (d₀/d)²
// so that the luminance holds at the reference distance d₀; with d₀ = 0 it holds at every distance,
// E[2.2-3]. A point at the place itself has no direction and gets nothing.
Incident from_place(Vec3 at, Vec3 place, Real reference_squared) {
    Vec3 way = place - at;
    Real squared = dot(way, way);
    Real distance = sqrt(squared);
    Incident incident;
    incident.direction = way * (Real(1) / distance);
    incident.reach = distance * Real(0.9999);
    incident.weight = select(reference_squared > Real(0), reference_squared / squared, Real(1));
    return incident;
}
