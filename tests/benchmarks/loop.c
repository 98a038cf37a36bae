/* The loop of svsa.simulation.loop.loop for Figure 4A with NDOBC and an ideal bench, as one would write it
 * in C to be quick: what `svsa bench` holds the compiled equations against.
 *
 * The same work: reference, domain, law, limits, loads, all channels of a sample, one Runge-Kutta
 * step of order 4, observer. The spring is evaluated once a state, its sine and cosine by
 * polynomials on |phi| <= pi/4. One run writes all samples; many lanes side by side, each with
 * constants of its own, keep the square and the greatest of the position error.
 *
 * cc -O3 -march=native -fno-math-errno -fno-trapping-math -shared -fPIC loop.c -lm
 */

#include <math.h>

#define LANES 32
#define CHANNELS 28  /* as many as `channels` names */
#define INLINE static inline __attribute__((always_inline))

/* The columns of `sample`: independent of the columns of a record. */
const char channels[] =
    "time_s position_reference_rad velocity_reference_rad_per_s stiffness_reference_nm_per_rad "
    "position_rad velocity_rad_per_s position_estimate_rad velocity_estimate_rad_per_s "
    "motor1_position_rad motor1_velocity_rad_per_s motor2_position_rad motor2_velocity_rad_per_s "
    "deflection_rad deflection_limit_rad lever_ratio stiffness_nm_per_rad position_error_rad "
    "stiffness_error_nm_per_rad torque1_nm torque2_nm disturbance_link_nm disturbance_motor1_nm "
    "disturbance_motor2_nm estimate_link_nm estimate_motor1_nm estimate_motor2_nm "
    "position_residual_rad stiffness_residual_nm_per_rad";

/* In the order in which svsa.evaluation.timing.benchmark hands them over. */
typedef struct {
    double M, B1, B2, D, D1, D2, K, slope, mu0;
    double nM, nB1, nB2, nD, nD1, nD2, nK, nslope, nmu0;
    double p0, p1, p2, p3, s0, s1, share2, share4, share6, u1_max, u2_max;
    double mu_min, mu_max, phi_max, phi_fraction, det_fraction, T;
    double q_amplitude, q_omega, sigma, w, w_start;
} Constants;

typedef struct { double q, dq, t1, dt1, t2, dt2; } State;
typedef struct { double link, m1, m2; } Three;
typedef struct { double s, c, d, mu, in, im; } Spring;
typedef struct { State x; Three w, F; } Lane;
typedef struct { double q, dq, ddq, dddq, ddddq; } Reference;
typedef struct { double u1, u2; } Torque;

INLINE Spring spring(double phi, double mu) {
    const double z = phi * phi;
    const double S = -1.66666666666666305e-01 + z * (8.33333333332211833e-03
        + z * (-1.98412698295896340e-04 + z * (2.75573136214008388e-06
        + z * (-2.50507477631366952e-08 + z * 1.58962300863313393e-10))));
    const double C = 4.16666666666665950e-02 + z * (-1.38888888888730578e-03
        + z * (2.48015872888523644e-05 + z * (-2.75573141794655168e-07
        + z * (2.08757008620147152e-09 - z * 1.13585374184477899e-11))));
    const double d = 0.5 * z - z * z * C, c = 1.0 - d;
    const double a = 1.0 - mu * c, b = 1.0 - mu, r = 1.0 / (a * b);
    return (Spring){phi + phi * z * S, c, d, mu, r * b, r * a};
}

INLINE Three torques(Spring p, State x, double K, double D, double D1, double D2, double slope) {
    const double Kmu = K * p.mu, elastic = Kmu * p.mu * p.s * p.c * p.in * p.in;
    const double reaction = Kmu * p.d * (p.im + p.c * p.in) * p.im * p.in * slope;
    return (Three){-D * x.dq - elastic, -D1 * x.dt1 + elastic, -D2 * x.dt2 - reaction};
}

INLINE State rate(const Constants *k, State x, Three F, Torque u, double w) {
    return (State){x.dq, (F.link + w) * (1.0 / k->M), x.dt1, (F.m1 + u.u1 + w) * (1.0 / k->B1),
                   x.dt2, (F.m2 + u.u2 + w) * (1.0 / k->B2)};
}

INLINE State plant_rate(const Constants *k, State x, Torque u, double w) {
    const Spring p = spring(x.q - x.t1, k->mu0 + x.t2 * k->slope);
    return rate(k, x, torques(p, x, k->K, k->D, k->D1, k->D2, k->slope), u, w);
}

INLINE State shift(State x, State r, double h) {
    return (State){x.q + h * r.q, x.dq + h * r.dq, x.t1 + h * r.t1, x.dt1 + h * r.dt1,
                   x.t2 + h * r.t2, x.dt2 + h * r.dt2};
}

INLINE double arc_cosine(double x) {
    const double z = 0.5 - 0.5 * x, s = sqrt(z);
    double p = 3.19119560382694400e-02;
    static const double P[11] = {
        1.66666666666654080e-01, 7.50000000033696500e-02, 4.46428568283655600e-02,
        3.03819591355451030e-02, 2.23717580823499450e-02, 1.73597043079330020e-02,
        1.38852397683466040e-02, 1.21691843784258280e-02, 6.52808974038655200e-03,
        1.95279599601413460e-02, -1.62237849435221270e-02};
    for (int i = 10; i >= 0; i--) p = P[i] + z * p;
    return 2.0 * (s + s * z * p);
}

INLINE double deflection_limit(const Constants *k, double mu) {
    const double zero = arc_cosine(0.25 * (mu + sqrt(mu * mu + 8.0)));
    const double share = k->phi_fraction * zero;
    return share < k->phi_max ? share : k->phi_max;
}

INLINE int inside(const Constants *k, Spring p, double phi, double limit, State x) {
    const double c3 = p.c * p.c * p.c, r = (1.0 - p.mu) * p.in, r2 = r * r;
    const double det = (1.0 - p.mu * c3) * r2 * r2 * r * p.in;
    const double sum = x.q + x.dq + x.t1 + x.dt1 + x.t2 + x.dt2;
    return (fabs(sum) < INFINITY) & (p.mu >= k->mu_min) & (p.mu <= k->mu_max)
        & (fabs(phi) <= limit) & (det >= k->det_fraction);
}

INLINE double clip(double u, double limit) {
    return u > limit ? limit : (u < -limit ? -limit : u);
}

INLINE Torque control(const Constants *k, Spring p, State x, Three F, Reference r, Three w) {
    const double rM = 1.0 / k->nM, rB1 = 1.0 / k->nB1, rB2 = 1.0 / k->nB2;
    const double s = p.s, c = p.c, mu = p.mu, slope = k->nslope;
    const double S = s * c, S1 = c * c - s * s, S2 = -4.0 * S, n1 = mu * s, n2 = mu * c;
    const double N = S1 - n2, N1 = S2 + n1, N2 = n2 - 4.0 * S1;
    const double i3 = p.in * p.in * p.in, i4 = i3 * p.in, i5 = i4 * p.in;
    const double Q = 2.0 * k->nK * mu, Kmu2 = k->nK * mu * mu;
    const double torque_mu = Q * S * i3;
    const double torque_mumu = 2.0 * k->nK * S * (1.0 + 2.0 * n2) * i4;
    const double sigma = Kmu2 * N * i3, sigma_phi = Kmu2 * (N1 * i3 - 3.0 * N * n1 * i4);
    const double sigma_mu = Q * (S1 * i3 - 3.0 * S * n1 * i4);
    const double sigma_phiphi = Kmu2
        * (N2 * i3 - (6.0 * N1 * n1 + 3.0 * N * n2) * i4 + 12.0 * N * n1 * n1 * i5);
    const double sigma_phimu = Q
        * (S2 * i3 - (6.0 * S1 * n1 + 3.0 * S * n2) * i4 + 12.0 * S * n1 * n1 * i5);
    const double sigma_mumu = 2.0 * k->nK * ((S1 * (1.0 + 2.0 * n2) - 2.0 * S * n1) * i4
        - 4.0 * S * (1.0 + 2.0 * n2) * n1 * i5);
    const double a = F.link * rM, dphi = x.dq - x.dt1, dmu = slope * x.dt2;
    const double ddphi = a - F.m1 * rB1, ddmu = slope * F.m2 * rB2;
    const double dtorque = sigma * dphi + torque_mu * dmu;
    const double ddtorque = sigma * ddphi + sigma_phi * dphi * dphi
        + 2.0 * sigma_mu * dphi * dmu + torque_mumu * dmu * dmu + torque_mu * ddmu;
    const double j = (-k->nD * a - dtorque) * rM, jounce = (-k->nD * j - ddtorque) * rM;
    const double dsigma = sigma_phi * dphi + sigma_mu * dmu;
    const double ddsigma = sigma_phi * ddphi + sigma_mu * ddmu + sigma_phiphi * dphi * dphi
        + 2.0 * sigma_phimu * dphi * dmu + sigma_mumu * dmu * dmu;
    const double a11 = sigma * rM * rB1, a12 = -torque_mu * slope * rM * rB2;
    const double a21 = -sigma_phi * rB1, a22 = sigma_mu * slope * rB2;
    const double g12 = (k->p2 - k->p3 * k->nD * rM + (k->nD * k->nD * rM - sigma) * rM) * rM;
    const double y1 = r.ddddq - jounce + k->p0 * (r.q - x.q) + k->p1 * (r.dq - x.dq)
        + k->p2 * (r.ddq - a) + k->p3 * (r.dddq - j)
        - (g12 * w.link + a11 * w.m1 + a12 * w.m2);
    const double y2 = -ddsigma + k->s0 * (k->sigma - sigma) - k->s1 * dsigma
        - (sigma_phi * rM * w.link + a21 * w.m1 + a22 * w.m2);
    const double det = 1.0 / (a11 * a22 - a12 * a21);
    return (Torque){clip((a22 * y1 - a12 * y2) * det, k->u1_max),
                    clip((a11 * y2 - a21 * y1) * det, k->u2_max)};
}

/* One tick of one lane; 0 where it has left the domain. sample: written, or NULL. */
INLINE int tick(const Constants *k, Lane *lane, Reference r, long number, double *sample) {
    const State x = lane->x;
    const double phi = x.q - x.t1, mu = k->mu0 + x.t2 * k->slope;
    const Spring p = spring(phi, mu), n = spring(phi, k->nmu0 + x.t2 * k->nslope);
    const double limit = deflection_limit(k, mu), w = number >= k->w_start ? k->w : 0.0;
    const int ok = inside(k, p, phi, limit, x);
    const Three F_old = lane->F, F = torques(p, x, k->K, k->D, k->D1, k->D2, k->slope);
    const Torque u = control(k, n, x, F_old, r, lane->w);
    const State k1 = rate(k, x, F, u, w);
    if (sample) {
        const double sigma = k->K * mu * mu * (2.0 * p.c * p.c - 1.0 - mu * p.c)
            * p.in * p.in * p.in;
        const double values[CHANNELS] = {
            number * k->T, r.q, r.dq, k->sigma, x.q, x.dq, x.q, x.dq, x.t1, x.dt1, x.t2, x.dt2,
            phi, limit, mu, sigma, r.q - x.q, k->sigma - sigma, u.u1, u.u2,
            k->nM * k1.dq - F_old.link, k->nB1 * k1.dt1 - F_old.m1 - u.u1,
            k->nB2 * k1.dt2 - F_old.m2 - u.u2, lane->w.link, lane->w.m1, lane->w.m2, 0.0, 0.0};
        for (int i = 0; i < CHANNELS; i++) sample[i] = values[i];
    }
    const double h = k->T;
    const State k2 = plant_rate(k, shift(x, k1, 0.5 * h), u, w);
    const State k3 = plant_rate(k, shift(x, k2, 0.5 * h), u, w);
    const State k4 = plant_rate(k, shift(x, k3, h), u, w);
    const State y = shift(shift(shift(shift(x, k1, h / 6.0), k2, h / 3.0), k3, h / 3.0), k4,
                          h / 6.0);
    const Spring m = spring(y.q - y.t1, k->nmu0 + y.t2 * k->nslope);
    const Three G = torques(m, y, k->nK, k->nD, k->nD1, k->nD2, k->nslope);
    const double rT = 1.0 / k->T;
    const double seen2 = k->nM * (y.dq - x.dq) * rT - 0.5 * (G.link + F_old.link);
    const double seen4 = k->nB1 * (y.dt1 - x.dt1) * rT - 0.5 * (G.m1 + F_old.m1) - u.u1;
    const double seen6 = k->nB2 * (y.dt2 - x.dt2) * rT - 0.5 * (G.m2 + F_old.m2) - u.u2;
    lane->w.link += k->share2 * (seen2 - lane->w.link);
    lane->w.m1 += k->share4 * (seen4 - lane->w.m1);
    lane->w.m2 += k->share6 * (seen6 - lane->w.m2);
    lane->x = y;
    lane->F = G;
    return ok;
}

INLINE Reference reference(double amplitude, double omega, double time) {
    const double s = amplitude * sin(omega * time), c = amplitude * cos(omega * time);
    const double o2 = omega * omega;
    return (Reference){s, omega * c, -o2 * s, -o2 * omega * c, o2 * o2 * s};
}

/* samples: (ticks, CHANNELS). The ticks done. */
long run_one(const Constants *constants, long ticks, double *samples) {
    const Constants k = *constants;
    Lane lane = {0};
    for (long i = 0; i < ticks; i++) {
        const Reference r = reference(k.q_amplitude, k.q_omega, i * k.T);
        if (!tick(&k, &lane, r, i, samples + i * CHANNELS)) return i;
    }
    return ticks;
}

/* constants: (40, 32). squares, peaks: (32,) of the position error. The ticks that all did. */
long run_lanes(const double (*restrict constants)[LANES], long ticks, double *restrict squares,
               double *restrict peaks) {
    double v[12][LANES] = {{0}};
    double e2[LANES] = {0}, peak[LANES] = {0};
    const double T = constants[34][0], amplitude = constants[35][0], omega = constants[36][0];
    for (long i = 0; i < ticks; i++) {
        const Reference r = reference(amplitude, omega, i * T);
        long left = 0;
#define C(f) constants[f][l]
        for (int l = 0; l < LANES; l++) {
            const Constants k = {
                C(0), C(1), C(2), C(3), C(4), C(5), C(6), C(7), C(8), C(9), C(10), C(11), C(12),
                C(13), C(14), C(15), C(16), C(17), C(18), C(19), C(20), C(21), C(22), C(23), C(24),
                C(25), C(26), C(27), C(28), C(29), C(30), C(31), C(32), C(33), C(34), C(35), C(36),
                C(37), C(38), C(39)};
            Lane lane = {{v[0][l], v[1][l], v[2][l], v[3][l], v[4][l], v[5][l]},
                         {v[6][l], v[7][l], v[8][l]}, {v[9][l], v[10][l], v[11][l]}};
            const double error = r.q - lane.x.q, size = fabs(error);
            left += !tick(&k, &lane, r, i, 0);
            e2[l] += error * error;
            peak[l] = size > peak[l] ? size : peak[l];
            v[0][l] = lane.x.q; v[1][l] = lane.x.dq; v[2][l] = lane.x.t1;
            v[3][l] = lane.x.dt1; v[4][l] = lane.x.t2; v[5][l] = lane.x.dt2;
            v[6][l] = lane.w.link; v[7][l] = lane.w.m1; v[8][l] = lane.w.m2;
            v[9][l] = lane.F.link; v[10][l] = lane.F.m1; v[11][l] = lane.F.m2;
        }
        if (left) return i;
    }
    for (int l = 0; l < LANES; l++) squares[l] = e2[l], peaks[l] = peak[l];
    return ticks;
}
