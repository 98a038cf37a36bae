import { expect, test } from "vitest";
import { splitSource } from "../../../src/evaluation/ranking/source";

test("a DOI at the end of a citation is what is linked", () => {
  const said = 'D. Q. Mayne, "Constrained model predictive control", Automatica 36(6), 2000, ';
  const doi = "10.1016/S0005-1098(99)00214-9";
  expect(splitSource(`${said}doi:${doi}`)).toEqual({ said, doi });
});

test("an equation, and a citation whose DOI nobody looked up, are not linked", () => {
  for (const source of ["Eq 24", 'P. Tomei, "A simple PD controller", 1991', ""]) {
    expect(splitSource(source)).toEqual({ said: source, doi: "" });
  }
});
