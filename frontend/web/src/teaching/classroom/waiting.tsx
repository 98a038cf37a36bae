import { handOver, isInstructor, lock, queue } from "../../core/state/control";
import { text } from "../../core/text/en";

const words = text.classroom;

/** Who waits for control, the first first; the instructor gives it to any, and locks it. */
export function Waiting() {
  const waiting = queue.value?.waiting ?? [];
  return (
    <section>
      <h3>{words.queue}</h3>
      {waiting.length === 0 && <p class="hint">{words.nobodyWaits}</p>}
      <ol class="class-queue">
        {waiting.map((one) => (
          <li key={one.id}>
            <div class="class-waits">
              <span>{one.name}</span>
              {isInstructor.value && (
                <button
                  type="button"
                  class="button is-small"
                  aria-label={words.give(one.name)}
                  onClick={() => void handOver(one.id)}
                >
                  {words.giveShort}
                </button>
              )}
            </div>
          </li>
        ))}
      </ol>
      {isInstructor.value && queue.value !== null && (
        <button
          type="button"
          class="button"
          title={words.lockHint}
          onClick={() => void lock(queue.peek()?.locked !== true)}
        >
          {queue.value.locked ? words.unlock : words.lock}
        </button>
      )}
    </section>
  );
}
