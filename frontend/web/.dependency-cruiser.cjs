/** The page's rooms, from top to bottom: a room imports what lies below it, and nothing else. */
const ROOMS = [
  ["main"],
  ["debug", "docs", "replay"],
  ["layout"],
  ["arena", "classroom", "falsifier", "grades", "leaderboard", "learning", "studies"],
  ["keys"],
  ["runs"],
  ["controls", "control", "safety", "scene", "script"],
  ["tuning"],
  ["bench", "design", "plots"],
  ["equations"],
  ["jobs", "widgets"],
  ["state"],
  ["stream"],
  ["api"],
  ["quantities"],
  ["units", "text", "icons"],
];

const within = (rooms) => `^src/(${rooms.join("|")})(/|\\.tsx?$)`;

/** @type {import("dependency-cruiser").IConfiguration} */
module.exports = {
  forbidden: [
    { name: "no circle", severity: "error", from: {}, to: { circular: true } },
    {
      name: "every file belongs to a room",
      severity: "error",
      from: {},
      to: {
        path: "^src/",
        pathNot: [within(ROOMS.flat()), "\\.css$", "\\.d\\.ts$"],
      },
    },
    ...ROOMS.flatMap((rooms, level) =>
      rooms.map((room) => ({
        name: `${room} imports what lies below it`,
        severity: "error",
        from: { path: within([room]) },
        to: {
          path: within(
            ROOMS.slice(0, level + 1)
              .flat()
              .filter((other) => other !== room),
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
