/**
 * In-browser translators replace text nodes. Preact then updates nodes that are no longer shown, or
 * fails to remove them. So a translator gets only explanations: elements with `translate`, and
 * hints. They consist of text alone, and are replaced as a whole when the text changes. Every other
 * element with text has `translate="no"`: states, actions and numbers are always those of the lab.
 */
import { type ComponentChildren, options, type VNode } from "preact";

/** Elements that contain other elements only, so that explanations may be among them. */
const STRUCTURE = new Set(
  (
    "a article aside details dialog div dl fieldset figure footer form g header li main nav ol " +
    "section svg table tbody tfoot thead tr ul"
  ).split(" "),
);
const FORMATS = new Set("b br code em i kbd small strong sub sup".split(" "));
const SVG_TEXTS = new Set(["text", "textPath", "title", "tspan"]);

type Element = VNode<{
  children?: ComponentChildren;
  class?: string;
  role?: string;
  translate?: boolean | string;
  dangerouslySetInnerHTML?: { __html: string };
}>;

const listChildren = (children: ComponentChildren): ComponentChildren[] =>
  Array.isArray(children) ? children.flatMap(listChildren) : [children];

const isText = (child: ComponentChildren): boolean =>
  typeof child === "string" || typeof child === "number";

const isEmpty = (child: ComponentChildren): boolean => child == null || typeof child === "boolean";

/** Text with formats, without components, signals and controls; null for anything else. */
function writeText(children: ComponentChildren): string | null {
  let text = "";
  for (const child of listChildren(children)) {
    if (isEmpty(child)) continue;
    if (isText(child)) text += child;
    else {
      const { type, props } = child as Element;
      const inner =
        typeof type === "string" && FORMATS.has(type) ? writeText(props.children) : null;
      if (inner === null) return null;
      text += `<${type as string}>${inner}`;
    }
  }
  return text;
}

function openFormats(children: ComponentChildren): void {
  for (const child of listChildren(children)) {
    if (isText(child) || isEmpty(child)) continue;
    const { props } = child as Element;
    delete props.translate;
    openFormats(props.children);
  }
}

function mark(element: Element, type: string): void {
  const { props } = element;
  const isExplanation =
    props.translate === true || (/\bhint\b/.test(props.class ?? "") && props.role === undefined);
  const text = isExplanation
    ? (props.dangerouslySetInnerHTML?.__html ?? writeText(props.children))
    : null;
  if (text !== null) {
    openFormats(props.children);
    props.translate = true;
    element.key = `${element.key ?? ""}${text}`;
  } else if (!STRUCTURE.has(type) || listChildren(props.children).some(isText)) {
    props.translate = SVG_TEXTS.has(type) ? "no" : false;
  }
}

const previous = options.vnode;
options.vnode = (node) => {
  if (typeof node.type === "string") mark(node as Element, node.type);
  previous?.(node);
};
