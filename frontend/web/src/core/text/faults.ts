/** What to try after a fault, by its code; none where its message says all there is to do. */
const faultAdvice: Readonly<Record<string, string>> = {
  lever_end:
    "A load bends a soft spring far, and to hold the stiffness meanwhile the law turns the spiral far and fast; whether to its end depends on when in the motion the load comes. A torque on the stiffness motor itself can do it, too. Try a stiffer setting, a smaller load, a slower motion, slower stiffness poles and observer (Place poles), or a law that gives way when it asks for more than the motors have (NDOBC-W, NDOBC-S).",
  deflection_limit:
    "Beyond this angle the spring pushes the wrong way, and no law can bring it back. Try a stiffer setting, a smaller load, a slower motion, or a law that gives way when it asks for more than the motors have (NDOBC-W, NDOBC-S).",
  singular_decoupling:
    "A soft spring that is bent far answers both motors nearly alike: to move position and stiffness apart would take torques that no motor has. Try a stiffer setting, a smaller load or a slower motion.",
  not_finite:
    "Gains or bandwidths are too fast for the loop's rate, so that it grows without bound. Take the last ones back (Undo), or set slower ones (Place poles).",
  overspeed:
    "Something turned faster than the bench file allows. Try a smaller or slower motion or load, and slower poles and observer (Place poles).",
  overload:
    "Let the motor cool. Then try a smaller or slower motion, or a smaller load: its current was above what it bears for long.",
  vibration:
    "Poles or observer are too fast for what the encoders see and the drives follow. Try slower ones (Place poles).",
};

const heatAdvice =
  "From 90 % of the heat that its winding bears on (I²t), a motor gives less than the law asks for, so that it is not burnt; what was left did not hold the load, and the actuator went where the fault says. Gains and laws do not help. Let the motor cool (under Details stands its heat), then try a load that asks less of that motor, or take it off sooner.";
const HELD_BACK = /_held_to_nm$/;

/** A fault that came while heat held a motor back has that as its reason, whatever its code. */
export const adviceOn = (code: string, values: Readonly<Record<string, unknown>>): string | null =>
  Object.keys(values).some((name) => HELD_BACK.test(name))
    ? heatAdvice
    : (faultAdvice[code] ?? null);
