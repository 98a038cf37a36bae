import { useId, useState } from "preact/hooks";
import { join, login } from "../api/access";
import { LONGEST_NAME, personName, rememberPerson } from "../state/preferences";
import { text } from "../text/en";
import { takeCode } from "./joincode";

const words = text.classroom;

interface FormProps {
  /** Tells what went wrong, or lets the page in. */
  enter: (way: () => Promise<unknown>) => void;
}

/** A student's name and the class code. */
function StudentForm({ enter }: FormProps) {
  const id = useId();
  const [name, setName] = useState(personName.peek());
  const [code, setCode] = useState(takeCode);
  const submit = (event: Event) => {
    event.preventDefault();
    enter(async () => {
      const joined = await join(name.trim(), code);
      rememberPerson(joined.name);
    });
  };
  return (
    <form onSubmit={submit}>
      <label for={`${id}-name`}>{text.control.name}</label>
      <input
        id={`${id}-name`}
        type="text"
        required
        maxLength={LONGEST_NAME}
        autocomplete="name"
        value={name}
        onInput={(event) => setName(event.currentTarget.value)}
      />
      <label for={`${id}-code`}>{words.code}</label>
      <input
        id={`${id}-code`}
        type="text"
        required
        maxLength={20}
        autocomplete="off"
        autocapitalize="characters"
        spellcheck={false}
        class="class-code"
        value={code}
        onInput={(event) => setCode(event.currentTarget.value)}
      />
      <button type="submit" class="button is-primary">
        {words.join}
      </button>
    </form>
  );
}

function InstructorForm({ enter }: FormProps) {
  const id = useId();
  const [token, setToken] = useState("");
  const submit = (event: Event) => {
    event.preventDefault();
    enter(() => login(token));
  };
  return (
    <form onSubmit={submit}>
      <label for={id}>{words.token}</label>
      <input
        id={id}
        type="password"
        required
        autocomplete="current-password"
        value={token}
        onInput={(event) => setToken(event.currentTarget.value)}
      />
      <button type="submit" class="button is-primary">
        {text.login.enter}
      </button>
    </form>
  );
}

/** How one comes into a class. */
export function Join({ enter }: FormProps) {
  const [isInstructor, setIsInstructor] = useState(false);
  return (
    <>
      {isInstructor ? <InstructorForm enter={enter} /> : <StudentForm enter={enter} />}
      <button type="button" class="quiet" onClick={() => setIsInstructor(!isInstructor)}>
        {isInstructor ? words.asStudent : words.asInstructor}
      </button>
    </>
  );
}
