import { problem } from "../state/actions";

/** Why the server refused what a control asked for. */
export function Problem({ control, id }: { control: string; id?: string }) {
  const isMine = problem.value?.control === control;
  return (
    <p class="problem" id={id} role="alert" hidden={!isMine}>
      {isMine && problem.value?.message}
    </p>
  );
}
