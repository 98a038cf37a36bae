import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import schema from "../../../../../docs/openapi.json";
import { type ApiSchema, tabulate } from "../../../operations";
import { stubBrowser } from "../../browser";

const REVISION = "1.0";
const IF_MATCH = { "If-Match": `"${REVISION}"` };

let sent: string[] = [];
let onSent = () => {};

async function load() {
  const { Edit, parametersOf, prepare } = await import("../../../src/core/api/operations");
  const client = await import("../../../src/core/api/client");
  const { perform, problem } = await import("../../../src/core/state/actions");
  const { jointChoice } = await import("../../../src/core/state/arm");
  const edit = new Edit(2, { revision: REVISION });
  return { client, perform, problem, jointChoice, parametersOf, prepare, edit };
}

beforeEach(() => {
  vi.resetModules();
  stubBrowser();
  sent = [];
  onSent = () => {};
  vi.stubGlobal("fetch", async (url: URL, { method, headers }: RequestInit) => {
    const { "If-Match": revision = "-", "Idempotency-Key": key } = headers as Record<
      string,
      string
    >;
    const path = url.pathname.split("/sessions/lab")[1];
    sent.push(`${method} ${path}${url.search} ${revision} ${key ? "key" : "-"}`);
    onSent();
    return new Response(JSON.stringify({ revision: `1.${sent.length}`, configuration: {} }));
  });
});
afterEach(() => vi.unstubAllGlobals());

describe("each operation of the schema", () => {
  const operations = Object.entries((schema as ApiSchema).paths).flatMap(([path, methods]) =>
    Object.entries(methods).map(([method, operation]) => ({
      method,
      template: path.replace("/api/v1", ""),
      names: (operation.parameters ?? []).map(({ name }) => name.toLowerCase()),
      role: operation["x-permission"],
    })),
  );

  it("gets joint, revision and key of the call exactly if it has the parameter", async () => {
    const { edit, parametersOf, prepare } = await load();
    expect(operations.filter(({ names }) => names.includes("joint")).length).toBeGreaterThan(5);
    for (const { method, template, names, role } of operations) {
      const { path, headers, hasKey } = prepare(method, template, { edit });
      const takes = (name: string) => names.includes(name);
      const name = `${method} ${template}`;
      expect(path.endsWith("?joint=2"), name).toBe(takes("joint"));
      expect(headers, name).toEqual(takes("if-match") ? IF_MATCH : {});
      expect(hasKey, name).toBe(takes("idempotency-key"));
      expect(parametersOf(method, template).permission, name).toBe(role);
    }
  });
});

it("a route that is added to the server has a correct call", async () => {
  const { edit, prepare } = await load();
  const names = { joint: "query", "if-match": "header", "Idempotency-Key": "header" };
  const parameters = Object.entries(names).map(([name, place]) => ({ name, in: place }));
  const home = { post: { parameters, "x-permission": "operator" } };
  const paths = { ...schema.paths, "/api/v1/sessions/{session}/position/home": home };
  const template = "/sessions/{session}/position/home";
  const query = { speed: 2 };
  expect(prepare("post", template, { edit, query }, tabulate({ paths }))).toEqual({
    path: "sessions/lab/position/home?speed=2&joint=2",
    headers: IF_MATCH,
    hasKey: true,
  });
  const both = prepare("post", template, { edit: edit.forJoint(null) }, tabulate({ paths }));
  expect(both.path).toBe("sessions/lab/position/home");
});

describe("a command of the user", () => {
  it("acts on the joint that was chosen when it began, in all its requests", async () => {
    const { client, jointChoice, perform } = await load();
    jointChoice.value = "2";
    onSent = () => {
      jointChoice.value = "1";
    };
    await perform("design.apply", async (edit) => {
      await client.putGains({})(edit);
      return client.putObserver(60, 60, 60)(edit);
    });
    expect(sent).toEqual(["PUT /gains?joint=2 - key", 'PUT /observer?joint=2 "1.1" key']);
  });

  it("has no joint if its route takes none: a file of the nominal model, a load at the tip", async () => {
    const { client, jointChoice, perform } = await load();
    jointChoice.value = "2";
    await perform("identification.file", client.putNominal(""));
    await perform("load", client.addLoad({ kind: "mass" } as never));
    await perform("load", client.addLoad({ kind: "constant", torque_nm: [1, 0, 0] } as never));
    expect(sent.filter((call) => !call.startsWith("GET"))).toEqual([
      "PUT /nominal - key",
      "POST /loads - key",
      "POST /loads?joint=2 - key",
    ]);
  });
});

it("a role of a class permits an operation as the schema says, and a lab without one all", async () => {
  const { access, mayCall } = await import("../../../src/core/state/access");
  const study = "/studies/{study}";
  const permitted = (role: string, authentication = "class") => {
    access.value = { authentication, role } as never;
    return [mayCall("get", study), mayCall("delete", study), mayCall("get", "/class/audit")];
  };
  expect(permitted("observer")).toEqual([true, false, false]);
  expect(permitted("operator")).toEqual([true, true, false]);
  expect(permitted("instructor")).toEqual([true, true, true]);
  expect(permitted("observer", "none")).toEqual([true, true, true]);
});
