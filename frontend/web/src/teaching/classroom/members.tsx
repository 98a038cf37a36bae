import { useSignal } from "@preact/signals";
import { type Member, readMembers, renewRejoinCodeOf } from "../../core/api/access";
import { t } from "../../core/text/t";

/**
 * All members, active or not, for the instructor; read when it is opened. A member who has lost
 * cookie and rejoin code gets a new code.
 */
export function Members({ attempt }: { attempt: (act: () => Promise<unknown>) => void }) {
  const members = useSignal<Member[] | null>(null);
  const renewed = useSignal<{ member: Member; code: string } | null>(null);
  const toggle = () => {
    renewed.value = null;
    if (members.peek() !== null) members.value = null;
    else
      attempt(async () => {
        members.value = await readMembers();
      });
  };
  const renew = (member: Member) =>
    attempt(async () => {
      const { rejoin_code: code } = await renewRejoinCodeOf(member.id);
      renewed.value = { member, code };
    });
  return (
    <section class="stack">
      <h3>
        <button type="button" class="quiet" aria-expanded={members.value !== null} onClick={toggle}>
          {members.value === null ? "▸" : "▾"} {t("classroom.members.title")}
        </button>
      </h3>
      {members.value !== null && <p class="hint">{t("classroom.members.hint")}</p>}
      {renewed.value !== null && (
        <p role="status">
          {t("classroom.members.codeOnce", { name: renewed.value.member.name })}{" "}
          <code class="strong nowrap class-return">{renewed.value.code}</code>
        </p>
      )}
      {members.value !== null && (
        <ul class="stack boxes">
          {members.value.map((member) => (
            <li key={member.id} class="row">
              <span class="grow">
                {member.name} <small class="nowrap">{member.id}</small>
              </span>
              <button
                type="button"
                class="button is-small"
                aria-label={t("classroom.members.renew", { name: member.name })}
                onClick={() => renew(member)}
              >
                {t("classroom.members.renewShort")}
              </button>
            </li>
          ))}
        </ul>
      )}
    </section>
  );
}
