// J. H. Lambert, Photometria, 1760: a point that shines alike in all directions, E[2.2-3]:
//
//     weight = (d₀/d)²,   1 without a reference distance d₀
Incident point_light(Vec3 at, PointLight light) {
    return from_place(at, light.position, light.reference_squared);
}
