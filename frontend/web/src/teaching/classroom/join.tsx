import { useId, useState } from "preact/hooks";
import { comeBack, join, login } from "../../core/api/access";
import { access } from "../../core/state/control";
import { LONGEST_NAME, personName, rememberPerson } from "../../core/state/preferences";
import { text } from "../../core/text/en";
import { takeCode } from "./joincode";
import { returnCode } from "./returncode";
import { type EnterProps, SecretForm } from "./secretform";

const words = text.classroom;

/** A student's name and the class code. */
function StudentForm({ enter }: EnterProps) {
  const id = useId();
  const [name, setName] = useState(personName.peek());
  const [code, setCode] = useState(takeCode);
  const submit = (event: Event) => {
    event.preventDefault();
    enter(async () => {
      const joined = await join(name.trim(), code);
      rememberPerson(joined.name);
      returnCode.value = joined.return_code;
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

const WAYS = ["student", "back", "instructor"] as const;

/** How one comes into a class: as somebody new, as who one was, or as the instructor. */
export function Join({ enter }: EnterProps) {
  const [chosen, choose] = useState<(typeof WAYS)[number]>("student");
  const comeIn = async (code: string) => {
    rememberPerson((await comeBack(code)).name);
  };
  return (
    <>
      {access.value?.removed === true && <p class="problem">{words.youAreRemoved}</p>}
      {chosen === "student" && <StudentForm enter={enter} />}
      {chosen === "back" && <SecretForm label={words.returnCode} enter={enter} send={comeIn} />}
      {chosen === "instructor" && <SecretForm label={words.token} enter={enter} send={login} />}
      <p class="login-ways">
        {WAYS.filter((way) => way !== chosen).map((way) => (
          <button key={way} type="button" class="quiet" onClick={() => choose(way)}>
            {words.ways[way]}
          </button>
        ))}
      </p>
    </>
  );
}
