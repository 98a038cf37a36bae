/** The tools of the 3D view. */
export const sceneText = {
  scene: {
    tools: "3D view",
    camera: "Camera",
    cameras: { whole: "Whole", front: "Front", side: "Side", spring: "Spring" },
    cameraHint: (name: string) => `Camera: ${name}`,
    push: "Push",
    pushHint: "Take the link with the mouse and pull: a spring pushes it towards the pointer",
    pushLayer:
      "Drag to push the link; the arrows left and right push by 1 N·m while they are down, Esc ends",
    pulling: (torque: string) => `${torque} N·m`,
    names: "Names of the parts",
    namesHint: "motors, spiral, pivot, lever and spring, in this window only",
    low: "Low graphics",
    lowHint: "Fewer parts, coarser, 15 pictures a second: for computers without a graphics card",
  },
} as const;
