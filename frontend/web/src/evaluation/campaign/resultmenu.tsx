import { Example } from "../../core/widgets/pagelayout";
import { type Place, PlaceLink } from "../../runs/list/place";

interface Result {
  key: string;
  to: Place;
  title: string;
  name: string;
  isExample?: boolean;
  /** Progress or outcome. */
  state: string;
}

interface ResultMenuProps {
  title: string;
  results: readonly Result[];
  /** Key of the shown result. */
  shown: string;
  /** Text while the results are being read. */
  loading?: string | false;
}

/** The saved results of a page, to select one. */
export function ResultMenu({ title, results, shown, loading }: ResultMenuProps) {
  return (
    <nav class="surface card menu" aria-label={title}>
      <h3>{title}</h3>
      {loading && <p class="hint">{loading}</p>}
      <ul>
        {results.map((result) => (
          <li key={result.key} aria-current={result.key === shown ? "page" : undefined}>
            <PlaceLink to={result.to} title={result.title}>
              <b>{result.name}</b> {result.isExample && <Example />}
              <small>{result.state}</small>
            </PlaceLink>
          </li>
        ))}
      </ul>
    </nav>
  );
}
