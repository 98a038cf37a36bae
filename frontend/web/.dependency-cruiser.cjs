/** The page's folders, from top to bottom: a folder may import only from folders below it. */
const FOLDERS = [
  ["main"],
  ["debug", "docs", "runs/replay"],
  ["layout"],
  ["teaching/classroom", "teaching/course", "teaching/grades", "teaching/leaderboard"],
  ["evaluation/falsifier", "evaluation/ranking", "evaluation/studies"],
  ["evaluation/campaign"],
  ["lab/actuators", "lab/keys"],
  ["runs/list"],
  ["lab/arm", "lab/lease", "lab/panels", "lab/safety", "lab/scene", "lab/script"],
  ["lab/tuning"],
  ["hardware", "lab/design"],
  ["core/plots"],
  ["core/equations", "core/forms"],
  ["core/jobs", "core/widgets"],
  ["core/state"],
  ["core/stream"],
  ["core/api"],
  ["core/quantities", "core/readnumber"],
  ["core/schema"],
  ["core/armgeometry", "core/icons", "core/rate", "core/scale", "core/translation", "core/units"],
  ["core/text"],
  ["core/stored"],
];

const within = (folders) => `^src/(${folders.join("|")})(/|\\.tsx?$)`;

/** @type {import("dependency-cruiser").IConfiguration} */
module.exports = {
  forbidden: [
    { name: "no circle", severity: "error", from: {}, to: { circular: true } },
    {
      name: "every file belongs to a folder",
      severity: "error",
      from: {},
      to: {
        path: "^src/",
        pathNot: [within(FOLDERS.flat()), "\\.css$", "\\.d\\.ts$"],
      },
    },
    ...FOLDERS.flatMap((folders, level) =>
      folders.map((folder) => ({
        name: `${folder} imports what lies below it`,
        severity: "error",
        from: { path: within([folder]) },
        to: {
          path: within(
            FOLDERS.slice(0, level + 1)
              .flat()
              .filter((other) => other !== folder),
          ),
        },
      })),
    ),
  ],
  options: {
    doNotFollow: { path: "node_modules" },
    tsConfig: { fileName: "tsconfig.json" },
    tsPreCompilationDeps: true,
  },
};
