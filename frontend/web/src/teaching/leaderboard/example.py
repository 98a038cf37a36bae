from svsa.actuators.linearization import compute_linearization, solve_decoupling


def build(model):
    """Feedback linearization; poles of the position at -a rad/s, of the stiffness at -b rad/s."""
    a, b = 45.0, 40.0

    def law(time_s, reference, x, w):
        now = compute_linearization(model, x)
        y1 = (
            reference.ddddq
            + a**4 * (reference.q - now.q)
            + 4 * a**3 * (reference.dq - now.dq)
            + 6 * a**2 * (reference.ddq - now.ddq)
            + 4 * a * (reference.dddq - now.dddq)
        )
        y2 = (
            reference.ddsigma
            + b**2 * (reference.sigma - now.sigma)
            + 2 * b * (reference.dsigma - now.dsigma)
        )
        u1, u2 = solve_decoupling(now, y1 - now.ddddq, y2 - now.ddsigma)
        return u1, u2  # N·m

    return law
