/**
 * Calls of the API by method and path of its schema. Joint, revision and idempotency key are added
 * to the operations whose schema has these parameters.
 */
import { request, sessionName } from "./request";
import type { paths } from "./schema";
import type { Joint, Method } from "./types";

/** Permission of the operations that are not in the table, and take no parameters. */
const READ = "observer";
type Table = Readonly<Record<string, readonly string[]>>;

/** From the schema, at build time: `vite.config.ts`. */
declare const __OPERATIONS__: Table;

/** The changes of one command of the user: its joint, and the revision on which it is based. */
export class Edit {
  /** joint: of an arm; null for both, and for a single joint. */
  constructor(
    readonly joint: Joint | null,
    readonly base: { revision: string | null },
  ) {}

  /** The same edit for another joint. */
  forJoint(joint: Joint | null): Edit {
    return new Edit(joint, this.base);
  }
}

type Below<P> = P extends `/api/v1${infer Rest}` ? Rest : never;
/** Paths with an operation of this method, such as "/sessions/{session}/law". */
export type Template<M extends Method> = {
  [P in keyof paths]: paths[P][M] extends undefined ? never : Below<P>;
}[keyof paths];
export type OperationOf<M extends Method, P extends Template<M>> = NonNullable<
  paths[`/api/v1${P}` & keyof paths][M]
>;

/** Fields that are left out have defaults: the schema's types require them. */
type Sparse<T> = T extends readonly unknown[]
  ? Readonly<T>
  : T extends object
    ? { [K in keyof T]?: Sparse<T[K]> | undefined }
    : T;
type BodyPart<O> = O extends { requestBody: { content: infer C } }
  ? { body: Sparse<C[keyof C]> }
  : unknown;
type PathPart<O> = O extends { parameters: { path: infer N } }
  ? keyof N extends "session"
    ? { path?: N }
    : { path: Omit<N, "session"> & Partial<N> }
  : unknown;
type QueryPart<O> = O extends { parameters: { query: infer Q } }
  ? { query: { [K in keyof Q]: Sparse<Q[K]> } }
  : O extends { parameters: { query?: infer Q } }
    ? { query?: Sparse<Omit<NonNullable<Q>, "joint">> }
    : unknown;
type Keys<T> = [NonNullable<T>] extends [never] ? never : keyof NonNullable<T>;
type Header<O> = O extends { parameters: { header?: infer H } } ? Keys<H> : never;
type Query<O> = O extends { parameters: { query?: infer Q } } ? Keys<Q> : never;
/** Whether an operation takes a joint or a revision: then its call needs an edit. */
export type TakesEdit<O> =
  "joint" extends Query<O> ? true : "if-match" extends Header<O> ? true : false;

/** Path parameters (the session is that of the page if left out), query and body of a call. */
export type Parts<O> = BodyPart<O> & PathPart<O> & QueryPart<O>;
type Options<O> = TakesEdit<O> extends true ? { edit: Edit | null } : { edit?: Edit | null };
export type Answer<O> = O extends { responses: infer R }
  ? R extends { 200: { content: { "application/json": infer A } } }
    ? A
    : R extends { 201: { content: { "application/json": infer A } } }
      ? A
      : unknown
  : never;

/** A call without its types. */
interface Prepared {
  path?: object | undefined;
  query?: object | undefined;
  body?: unknown;
  edit?: Edit | null | undefined;
}

/** Path with the values of its parameters. */
export const fillPath = (template: string, values: object = {}): string =>
  Object.entries({ session: sessionName, ...values }).reduce(
    (path, [name, value]) => path.replace(`{${name}}`, encodeURIComponent(value)),
    template,
  );

/** The parameters that the page adds to an operation, and its permission. */
export function parametersOf(method: string, template: string, table = __OPERATIONS__) {
  const operation = `${method} ${template}`.replace("/sessions/{session}", "~");
  const takes = Object.keys(table).find((key) => table[key]?.includes(operation)) ?? READ;
  const [permission, ...parameters] = takes.split(" ");
  return { permission, parameters };
}

/** Address and headers of a call. */
export function prepare(
  method: string,
  template: string,
  { path, query = {}, edit }: Prepared,
  table?: Table,
) {
  const { parameters } = parametersOf(method, template, table);
  const search = new URLSearchParams();
  for (const [name, value] of Object.entries(query)) {
    for (const each of [value].flat()) if (each !== undefined) search.append(name, String(each));
  }
  if (edit?.joint && parameters.includes("joint")) search.set("joint", String(edit.joint));
  const revision = parameters.includes("if-match") ? edit?.base.revision : null;
  return {
    path: `${fillPath(template, path).slice(1)}${search.size > 0 ? `?${search}` : ""}`,
    headers: revision ? { "If-Match": `"${revision}"` } : {},
    hasKey: parameters.includes("idempotency-key"),
  };
}

/** Call an operation of the API; timeoutMs: longest time without a received byte. */
export function call<M extends Method, P extends Template<M> & string>(
  method: M,
  template: P,
  parts: Parts<OperationOf<M, P>> & Options<OperationOf<M, P>>,
  timeoutMs?: number,
): Promise<Answer<OperationOf<M, P>>> {
  const { path, headers, hasKey } = prepare(method, template, parts as Prepared);
  const { body } = parts as Prepared;
  return request(method, path, body, timeoutMs, headers, hasKey) as Promise<
    Answer<OperationOf<M, P>>
  >;
}
