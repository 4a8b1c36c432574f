// A headless Chromium for tests and measurements: pages from folders of this machine, and Chromium's own protocol over pipes.

import { spawn } from "node:child_process";
import { once } from "node:events";
import { mkdtempSync, rmSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join, normalize } from "node:path";

import { chromium } from "./machine.mjs";

const CONTENT_TYPES = { ".html": "text/html", ".mjs": "text/javascript", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm" };

// Pages that are isolated have clocks of 5 microseconds.
const ISOLATED = { "cross-origin-opener-policy": "same-origin", "cross-origin-embedder-policy": "require-corp" };

/**
 * Calls use(browser) and ends the browser. `folders` are served by the first part of their path: { package: "build/web" }
 * has /package/rimline.mjs. The page / is empty.
 */
export async function withBrowser(folders, use) {
  const server = createServer(async (request, response) => {
    if (request.url === "/") return response.writeHead(200, { ...ISOLATED, "content-type": "text/html" }).end("<!doctype html>");
    const [, name, ...rest] = decodeURI(new URL(request.url, "http://localhost").pathname).split("/");
    const path = folders[name] && join(folders[name], normalize(`/${rest.join("/")}`));
    try {
      const content = await readFile(path);
      response.writeHead(200, { ...ISOLATED, "content-type": CONTENT_TYPES[extname(path)] ?? "application/octet-stream" });
      response.end(content);
    } catch {
      response.writeHead(404).end();
    }
  });
  server.listen(0, "127.0.0.1");
  await once(server, "listening");
  const profile = mkdtempSync(join(tmpdir(), "rimline-chromium-"));
  const browser = new Browser(profile, `http://127.0.0.1:${server.address().port}`);
  try {
    return await use(browser);
  } finally {
    await browser.close();
    server.close();
    rmSync(profile, { recursive: true, force: true, maxRetries: 10 });
  }
}

class Browser {
  #process;
  #waiting = new Map(); // Calls without an answer, by their number.
  #calls = 0;
  #session;
  #received = "";
  #loaded;
  #problems = [];

  constructor(profile, origin) {
    this.origin = origin;
    const options = [
      "--headless=new", "--no-sandbox", "--no-first-run", "--disable-gpu-sandbox", "--enable-unsafe-swiftshader",
      "--use-angle=swiftshader", "--hide-scrollbars", "--remote-debugging-pipe", `--user-data-dir=${profile}`,
    ];
    this.#process = spawn(chromium, options, { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    this.#process.once("exit", () => this.#fail(new Error("Chromium ended")));
    this.#process.once("error", (error) => this.#fail(error));
    this.#process.stdio[4].setEncoding("utf-8").on("data", (text) => this.#receive(text));
  }

  /** Opens a page of a served folder, of this size in pixels. Ends when the page and its scripts are loaded. */
  async open(path, { width = 1280, height = 800 } = {}) {
    const { targetId } = await this.call("Target.createTarget", { url: "about:blank" });
    this.#session = (await this.call("Target.attachToTarget", { targetId, flatten: true })).sessionId;
    await this.call("Runtime.enable");
    await this.call("Page.enable");
    await this.call("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
    const loaded = new Promise((resolve) => (this.#loaded = resolve));
    await this.call("Page.navigate", { url: this.origin + path });
    await loaded;
  }

  /** The value of an expression, which may be a promise. Throws what it throws. */
  async evaluate(expression) {
    const { result, exceptionDetails } = await this.call("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  /** PNG, of the whole page or of `clip`: { x, y, width, height, scale }. */
  async screenshot(clip) {
    return Buffer.from((await this.call("Page.captureScreenshot", { format: "png", clip })).data, "base64");
  }

  /** Warnings, errors and exceptions of the page so far. */
  get problems() {
    return this.#problems;
  }

  async call(method, params = {}) {
    const id = ++this.#calls;
    const answer = new Promise((resolve, reject) => this.#waiting.set(id, { resolve, reject }));
    this.#process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId: this.#session })}\0`);
    return answer;
  }

  async close() {
    if (this.#process.exitCode !== null || this.#process.pid === undefined) return;
    const ended = once(this.#process, "exit");
    this.#session = undefined;
    this.call("Browser.close").catch(() => {});
    await ended;
  }

  #receive(text) {
    const messages = (this.#received + text).split("\0");
    this.#received = messages.pop();
    for (const message of messages.map((json) => JSON.parse(json))) {
      const { id, method, params, result, error } = message;
      if (method === "Page.loadEventFired") this.#loaded();
      if (method === "Runtime.exceptionThrown") this.#problems.push(params.exceptionDetails.exception?.description);
      if (method === "Runtime.consoleAPICalled" && ["warning", "error"].includes(params.type))
        this.#problems.push(params.args.map((argument) => argument.value ?? argument.description).join(" "));
      const call = this.#waiting.get(id);
      this.#waiting.delete(id);
      if (error) call?.reject(new Error(error.message));
      else call?.resolve(result);
    }
  }

  #fail(error) {
    for (const { reject } of this.#waiting.values()) reject(error);
    this.#waiting.clear();
  }
}
