// The places of a triangle at which the interpolating kinds of shading (2.3) evaluate the model, counted
// from 0: the centroid; the three corners; or the corners 0 1 2 and the middles 3 4 5 of the edges 01,
// 02, 12. And how much of each place a point of the triangle sees.

// v1::Shading.
const int constant_shading = 1;
const int gouraud_shading = 2;
const int quadratic_shading = 3;

int place_count(int shading) {
    return shading == constant_shading ? 1 : shading == gouraud_shading ? 3 : 6;
}

// What the point 1 − u − v, u, v (barycentric) sees of a place; they sum to 1. Those of QUADRATIC are the
// only quadratic functions that are 1 at one place and 0 at the others, so the sum is E[2.3-1] with the
// coefficients E[2.3-2]; between its corners they may be negative.
Real place_weight(int shading, int place, Real u, Real v) {
    Real w = Real(1) - u - v;
    if (shading == constant_shading) return Real(1);
    if (place < 3) {
        Real part = place == 0 ? w : place == 1 ? u : v;
        return shading == gouraud_shading ? part : part * (Real(2) * part - Real(1));
    }
    Real first = place == 5 ? u : w;
    Real second = place == 3 ? u : v;
    return Real(4) * first * second;
}

// Its corners; normals and tangents of any length, a normal of length 0 where a corner has none.
struct Triangle {
    Vec3 position[3];
    Vec3 normal[3];
    Vec3 tangent[3];
    Vec3 across;  // takes a tangent's place where that is along the normal
};

struct Place {
    Vec3 position;
    Vec3 normal;  // unit, on the side of `side`
    Vec3 tangent;
};

// That of a corner, by its number.
Vec3 at_corner(Real corner, Vec3 first, Vec3 second, Vec3 third) {
    return select(corner == Real(0), first, select(corner == Real(1), second, third));
}

// `side`: the triangle's normal towards the eye, unit.
Place place_of(Triangle at, Vec3 side, int shading, Real place) {
    Place result;
    if (shading == constant_shading) {
        result.position = (at.position[0] + at.position[1] + at.position[2]) / Real(3);
        result.normal = side;
        result.tangent = (at.tangent[0] + at.tangent[1] + at.tangent[2]) / Real(3);
    } else {
        // Find the two corners that the place lies between; a corner lies between itself and itself.
        Real p = select(place < Real(3), place, select(place == Real(5), Real(1), Real(0)));
        Real q = select(place < Real(3), place, select(place == Real(3), Real(1), Real(2)));
        Vec3 position_p = at_corner(p, at.position[0], at.position[1], at.position[2]);
        Vec3 position_q = at_corner(q, at.position[0], at.position[1], at.position[2]);
        Vec3 tangent_p = at_corner(p, at.tangent[0], at.tangent[1], at.tangent[2]);
        Vec3 tangent_q = at_corner(q, at.tangent[0], at.tangent[1], at.tangent[2]);
        result.position = (position_p + position_q) * Real(0.5);
        result.tangent = (tangent_p + tangent_q) * Real(0.5);
        result.normal = at_corner(p, at.normal[0], at.normal[1], at.normal[2]);
        if (shading == quadratic_shading) {
            // A middle is of unit normals, so that a long one does not outweigh its neighbour.
            Vec3 normal_q = at_corner(q, at.normal[0], at.normal[1], at.normal[2]);
            Vec3 middle = (unit(result.normal) + unit(normal_q)) * Real(0.5);
            result.normal = select(place < Real(3), result.normal, middle);
        }
    }

    // A corner without a normal has the triangle's.
    Vec3 normal = unit(result.normal);
    normal = select(dot(normal, normal) == Real(0), side, normal);
    result.normal = select(dot(normal, side) < Real(0), normal * Real(-1), normal);
    result.tangent = steady_tangent(result.normal, result.tangent, at.across);
    return result;
}
