/** The documentation of REST and stream: Swagger UI, served by this server only. */
import { effect } from "@preact/signals";
import SwaggerUI from "swagger-ui-dist/swagger-ui-es-bundle.js";
import "swagger-ui-dist/swagger-ui.css";
import "./docs.css";
import { theme } from "../core/state/preferences";

effect(() => {
  document.documentElement.classList.toggle("dark-mode", theme.value === "dark");
});

SwaggerUI({
  url: "openapi.json",
  dom_id: "#docs",
  deepLinking: true,
  validatorUrl: null,
  defaultModelsExpandDepth: 0,
});
