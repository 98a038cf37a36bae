/** The equations of the paper with their numbers, and the form that is computed here. */

export interface Equation {
  /** Number in the paper; left out if the paper has none. */
  number?: string;
  tex: string;
  /** The printed form, if it contains an error. */
  printed?: string;
  /** Law whose own equation replaces this one. */
  law?: string;
  /** Key of the note in `text.equations.notes`. */
  note?: NoteKey;
}

type NoteKey =
  | "lever"
  | "zeroStiffness"
  | "signLaw"
  | "signError"
  | "observer"
  | "discrete"
  | "rest"
  | "reaction"
  | "load"
  | "mass"
  | "fade";

export type Topic =
  | "motion"
  | "position"
  | "error"
  | "stiffness"
  | "stiffnessError"
  | "torque"
  | "disturbance"
  | "deflection"
  | "phase"
  | "controller"
  | "load";

const LINK: Equation = {
  number: "1",
  tex: String.raw`M\ddot q + D\dot q + \tau_e + \tau_g(q) = \tau_{ext}`,
};
const STIFFNESS: Equation = {
  number: "3",
  tex: String.raw`\sigma=\frac{\partial\tau_e}{\partial\varphi}=K\mu^2\,\frac{\cos2\varphi-\mu\cos\varphi}{(1-\mu\cos\varphi)^3}`,
};
const LEVER: Equation = {
  number: "4",
  tex: String.raw`\mu=\mu_0+\frac{\theta_2}{2\pi\gamma},\qquad \mu(\sigma)=\frac{r}{1+r},\; r=\sqrt{\sigma/K}`,
  note: "lever",
};
const ERROR_DYNAMICS: Equation = {
  number: "23",
  tex: String.raw`\dot E=b-A\,u+D\,w`,
  printed: String.raw`\dot E=b+A\,u+D\,w`,
  note: "signError",
};
const POLES: Equation = {
  number: "25",
  tex: String.raw`s^4+c^1_3s^3+c^1_2s^2+c^1_1s+c^1_0,\qquad s^2+c^2_1s+c^2_0`,
};

export const EQUATIONS: Record<Topic, readonly Equation[]> = {
  motion: [
    {
      tex: String.raw`q_d(t)=q_0+A\,\sin(2\pi f\,t)`,
      note: "fade",
    },
  ],
  position: [
    LINK,
    {
      number: "1",
      tex: String.raw`B_1\ddot\theta_1+D_1\dot\theta_1-\tau_e=u_1,\qquad B_2\ddot\theta_2+D_2\dot\theta_2+\tau_r=u_2`,
    },
  ],
  error: [
    ERROR_DYNAMICS,
    {
      tex: String.raw`(q_d-q)_\infty=-\,\Gamma_1 w\,/\,c^1_0\quad\text{(FL)},\qquad 0\quad\text{(NDOBC)}`,
      note: "rest",
    },
  ],
  stiffness: [STIFFNESS, LEVER],
  stiffnessError: [
    {
      tex: String.raw`(\sigma_d-\sigma)_\infty=-\,\Gamma_2 w\,/\,c^2_0\quad\text{(FL)}`,
      note: "rest",
    },
    {
      number: "5",
      tex: String.raw`\tau_r=\frac{\partial V}{\partial\theta_2}=\frac{K\mu}{2\pi\gamma}\Bigl[\tfrac1{(1-\mu)^2}-\tfrac{\cos^2\varphi}{(1-\mu\cos\varphi)^2}\Bigr]`,
      printed: String.raw`\tau_r=\frac{K_sR^2a^2\sin2\beta\,\sin^2\varphi}{2(R-a\cos\varphi)(a^2+R^2-2aR\cos\varphi)}`,
      note: "reaction",
    },
  ],
  torque: [
    {
      number: "24",
      tex: String.raw`u=A^{-1}\,(b-v-\Gamma\hat w)`,
      printed: String.raw`u=A^{-1}\,(-b+v+\Gamma\hat w)`,
      note: "signLaw",
    },
    {
      number: "18",
      tex: String.raw`A=\begin{bmatrix}\dfrac{\sigma}{MB_1}&-\dfrac{\tau_{e,\mu}\,\mu'}{MB_2}\\[1.2ex]-\dfrac{\sigma_\varphi}{B_1}&\dfrac{\sigma_\mu\,\mu'}{B_2}\end{bmatrix}`,
    },
  ],
  disturbance: [
    {
      number: "16",
      tex: String.raw`\dot z_i=-\frac{k_i}{J_i}\,(z_i+k_iv_i+F_i),\qquad \hat w_i=z_i+k_iv_i`,
      printed: String.raw`\dot z_{2,4,6}:\ \text{mixed indices of }k_w,\ D\text{ in row 6}`,
      note: "observer",
    },
    {
      tex: String.raw`\hat w\leftarrow\hat w+(1-e^{-\beta T})\Bigl[J\tfrac{\Delta v}{T}-\tfrac12(F_{new}+F_{old})-u-\hat w\Bigr]`,
      note: "discrete",
    },
  ],
  deflection: [
    {
      number: "2",
      tex: String.raw`\varphi=q-\theta_1,\qquad \tau_e=\frac{K\mu^2\sin\varphi\cos\varphi}{(1-\mu\cos\varphi)^2}`,
    },
    { tex: String.raw`\sigma=0\ \text{at}\ \cos2\varphi=\mu\cos\varphi`, note: "zeroStiffness" },
  ],
  phase: [POLES, ERROR_DYNAMICS],
  controller: [
    {
      number: "36",
      law: "fl",
      tex: String.raw`\text{FL:}\quad u=A^{-1}\,(b-v)`,
      printed: String.raw`u=A^{-1}\,(v-b)`,
    },
    {
      number: "24",
      law: "ndobc",
      tex: String.raw`\text{NDOBC:}\quad u=A^{-1}\,(b-v-\Gamma\hat w)`,
      printed: String.raw`u=A^{-1}\,(-b+v+\Gamma\hat w)`,
      note: "signLaw",
    },
    { ...POLES },
  ],
  load: [
    { tex: String.raw`w=(w_2,w_4,w_6)=(2,2,2)\ \mathrm{N\,m}`, note: "load" },
    { tex: String.raw`(M+mr^2)\,\ddot q+\dots+m g r\sin q=\dots`, note: "mass" },
  ],
};

export const TOPICS = Object.keys(EQUATIONS) as Topic[];
