interface BoxesProps {
  offered: readonly { name: string; title: string }[];
  chosen: readonly string[];
  onChange: (chosen: readonly string[]) => void;
}

/** Any of some things, each a box. */
export function Boxes({ offered, chosen, onChange }: BoxesProps) {
  return (
    <div class="desk-boxes">
      {offered.map(({ name, title }) => (
        <label key={name}>
          <input
            type="checkbox"
            checked={chosen.includes(name)}
            onChange={() =>
              onChange(
                chosen.includes(name) ? chosen.filter((one) => one !== name) : [...chosen, name],
              )
            }
          />{" "}
          {title}
        </label>
      ))}
    </div>
  );
}
