// A light that is so far away that it comes from one direction, and is as bright, everywhere:
//
//     weight = 1
Incident directional_light(Vec3 at, DirectionalLight light) {
    Incident incident;
    incident.direction = light.direction * Real(-1);
    incident.reach = Real(3.4028235e38);
    incident.weight = Real(1);
    return incident;
}
