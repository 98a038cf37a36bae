/** Text to the clipboard, or into a file. */

/** False where the browser does not let a page copy. */
export async function copyText(content: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(content);
    return true;
  } catch {
    return false;
  }
}

export function saveText(content: string, fileName: string): void {
  const address = URL.createObjectURL(new Blob([content], { type: "text/x-python" }));
  const link = document.createElement("a");
  link.href = address;
  link.download = fileName;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address));
}
