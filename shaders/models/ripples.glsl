// How much a rough surface scatters by diffraction at one wavelength, for a lobe's height and spread
// (lobes.glsl). X. D. He et al., 1991, their D, without what models have in their weights:
//
//     q² Σ g^(m−1) e^(−g)/(m! m) e^(−s/m), m from 1,   g = q height, s = q spread, q = (2π/λ)², λ in µm
//
// The m-th term is light that the heights have scattered m times; together they are a Poisson distribution's mean
// of e^(−s/m)/m. For g of thousands, or a spread that reaches far beyond it, millions of terms would be
// summed. Only those about the largest one count; m^2 ln(m/g) = s has it, in W, Lambert's function, at
//
//     m = g e^x, 2x = W(2s/g²), of the width w = √(m/(1 + 2x))
//
// and where it is wide and far from 1, each of n points a step of about w apart stands for a step of terms:
// the sum over a smooth peak is its integral, to 2 exp(−2π² (w/step)²) of it. Where it is near 1 the first terms are
// summed each, and the points move apart behind them: the k-th is m = k + bend k³.
//
// A caller asks for ripples_of, then sums ripple over k = 0, 1, … below `count`. What it wants to be accurate to it
// says by `reach`, in widths, `most` points near 1, and `pitch`, the points' distance in widths: reach 5, most 24 and pitch
// 1 are right to 5e-5, also 30 orders of magnitude below the peak; 5.5, 32 and 0.9 to 1e-6.
struct Ripples {
    Real height;  // g
    Real spread;  // s
    Real first;   // Of the points, m at k = −1 or 0: see `near`.
    Real step;
    Real bend;
    Real near;    // 1: m = k + 1 + bend (k + 1)³; 0: m = first + k step.
    Real count;
};

// W(x) for x ≥ 0: S. Winitzki's approximation, "Uniform approximations for transcendental functions", 2003, to 2 %,
// and one of Newton's steps for w + ln w = ln x, each of which squares the error.
Real lambert_w_start(Real x) {
    Real l = log(Real(1) + x);
    return l * (Real(1) - log(Real(1) + l) / (Real(2) + l));
}
Real lambert_w_step(Real x, Real w) {
    Real from = max(w, Real(1e-30));
    return from * (Real(1) + log(max(x, Real(1e-30)) / from)) / (Real(1) + from);
}
Real lambert_w(Real x) {
    Real w = lambert_w_step(x, lambert_w_step(x, lambert_w_step(x, lambert_w_start(x))));
    return x > Real(1e-9) ? w : x;
}

Ripples ripples_of(Real height, Real spread, Real q, Real reach, Real most, Real pitch) {
    Ripples r;
    r.height = max(height * q, Real(1e-30));
    r.spread = spread * q;

    // Find the largest term, and its width.
    Real share = min(r.spread / r.height, Real(1e30)) / r.height;
    Real twice = min(Real(2) * share, Real(1e30));
    Real step = lambert_w_step(twice, lambert_w_start(twice));
    Real x = Real(0.5) * (twice > Real(1e-6) ? step : twice);
    Real middle = r.height * exp(x);
    Real width = sqrt(middle / (Real(1) + Real(2) * x));

    // Put the points about it.
    Real low = middle - reach * width;
    Real high = middle + reach * width + Real(0.9) * reach;
    Real near_count = min(most, -floor(-high));
    Real far_steps = -floor(-Real(2) * reach / pitch);
    Real far_step = Real(2) * reach * width / far_steps;
    bool near = low <= Real(1);
    bool wide = far_step > Real(1);
    Real each_count = -floor(-Real(2) * reach * width) + Real(3);
    r.near = near ? Real(1) : Real(0);
    r.first = wide ? low : floor(low);
    r.step = wide ? far_step : Real(1);
    r.bend = max(high - near_count, Real(0)) / (near_count * near_count * near_count);
    r.count = near ? near_count : (wide ? far_steps + Real(1) : each_count);
    return r;
}

// ln(x/y): next to 1 by the difference, as it counts a thousand times.
Real log_of_ratio(Real x, Real y) {
    Real s = (x - y) / (x + y);
    Real s2 = s * s;
    Real series = Real(1.0 / 7.0) + s2 * (Real(1.0 / 9.0) + s2 * (Real(1.0 / 11.0) + s2 * Real(1.0 / 13.0)));
    series = Real(1) + s2 * (Real(1.0 / 3.0) + s2 * (Real(0.2) + s2 * series));
    Real far = log(x / y);
    return abs(s) < Real(0.1) ? Real(2) * s * series : far;
}

// What the k-th point stands for. The factorial by J. Stirling's series at M = m + 6, and 6 factors.
Real ripple(Ripples r, Real q, Real k) {
    Real at = k + Real(1);
    bool near = r.near > Real(0.5);
    Real m = near ? at + r.bend * (at * at * at) : r.first + k * r.step;
    Real stands_for = near ? Real(1) + Real(3) * r.bend * (at * at) : r.step;
    m = max(m, Real(1));
    Real above = m + Real(6);
    Real one_by = Real(1) / above;
    Real square = one_by * one_by;
    Real series = one_by * (Real(1.0 / 12.0) -
                            square * (Real(1.0 / 360.0) -
                                      square * (Real(1.0 / 1260.0) - square * Real(1.0 / 1680.0))));
    Real exponent = (above - r.height) - (m - Real(1)) * log_of_ratio(above, r.height) - series - r.spread / m;
    Real product = (Real(1) - one_by) * (Real(1) - Real(2) * one_by) * (Real(1) - Real(3) * one_by) *
                   (Real(1) - Real(4) * one_by) * (Real(1) - Real(5) * one_by);
    Real value = exp(min(exponent, Real(80))) * product * stands_for /
                 (sqrt(Real(6.28318530717958647692) * above) * above * m);
    return k < r.count ? q * q * value : Real(0);
}
