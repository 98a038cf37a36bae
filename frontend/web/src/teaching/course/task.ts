import type { Exercise, Step } from "../../core/api/course";

/** What a step's task is given. onDone: called when what came of it is shown in place of what was asked. */
export interface Task {
  of: Step;
  exercise: Exercise;
  onDone: () => void;
}
