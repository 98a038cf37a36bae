import { useEffect, useId, useRef, useState } from "preact/hooks";
import { login } from "../core/api/access";
import { RefusedError } from "../core/api/errors";
import { access, loginCount, updateAccess } from "../core/state/access";
import { openStream, phase } from "../core/state/session";
import { t } from "../core/text/t";
import { ErrorLine } from "../core/widgets/form";
import { StopBanners, StopButton } from "../lab/safety/stopbanner";
import { Join, SecretForm } from "../teaching/classroom/join";

/** Login with a secret, code or token; the server keeps it in a cookie. */
export function Login() {
  const id = useId();
  const dialog = useRef<HTMLDialogElement>(null);
  const [problem, setProblem] = useState("");
  useEffect(() => {
    void updateAccess();
    dialog.current?.showModal();
  }, []);

  const enter = async (way: () => Promise<unknown>) => {
    try {
      await way();
      await updateAccess();
      loginCount.value += 1;
      phase.value = "connecting";
      openStream();
    } catch (error) {
      setProblem(error instanceof RefusedError ? error.message : t("connection.unreachable"));
    }
  };
  const method = access.value?.authentication;
  const isJoined = method === "class";
  return (
    <dialog
      ref={dialog}
      class="floating stack loose login"
      aria-labelledby={`${id}-title`}
      onCancel={(event) => event.preventDefault()}
    >
      <h2 id={`${id}-title`}>{isJoined ? t("classroom.title") : t("login.title")}</h2>
      <p translate>{isJoined ? t("classroom.explanation") : t("login.explanation")}</p>
      {isJoined ? (
        <Join enter={(way) => void enter(way)} />
      ) : (
        <SecretForm label={t("login.secret")} enter={(way) => void enter(way)} send={login} />
      )}
      <ErrorLine>{problem}</ErrorLine>
      {access.value?.stops_without_login && (
        <>
          <StopBanners />
          <StopButton />
        </>
      )}
    </dialog>
  );
}
