// The table of findings: sorted, filtered, a hundred rows at a time; a row jumps to its pose.
import { signSpan } from "./signs.js";
import { bladeText, millimetres } from "./run.js";

const kRows = 100;
const kSides = ["–", "forward", "backward", "convex", "concave"];

/** A finding is [place, verdict, part, blade, side, depth or null, pose]; pose is where a motion leads, or -1. */
export class FindingsTable {
  constructor(run, player) {
    this.run = run;
    this.player = player;
    this.page = 0;
    this.sort = { column: 0, descending: false };
    this.wanted = { verdict: "", part: "", blade: "" };
    const bladeOf = ([, , , blade]) => (blade < 0 ? "–" : bladeText(run, blade));
    this.columns = [
      { name: run.findings.where, key: (row) => row[0], text: (row) => this.whereOf(row), button: true },
      { name: "Verdict", key: (row) => row[1], text: (row) => run.verdicts[row[1]].name, sign: true },
      { name: "Part", key: (row) => this.partOf(row), text: (row) => this.partOf(row) },
      { name: "Blade", key: (row) => row[3], text: bladeOf },
      { name: "Side", key: (row) => row[4], text: (row) => kSides[row[4]] },
      { name: run.findings.value, key: (row) => row[5] ?? -Infinity, text: (row) => (row[5] === null ? "–" : millimetres(row[5])), numeric: true },
    ];
    if (run.findings.value === "") this.columns.pop();
    this.head = document.querySelector("#table thead tr");
    this.body = document.querySelector("#table tbody");
    this.makeHead();
    document.getElementById("page-back").onclick = () => this.turn(-1);
    document.getElementById("page-on").onclick = () => this.turn(1);
    this.body.addEventListener("click", (event) => {
      const row = event.target.closest("tr");
      if (!row?.dataset.at) return;
      this.player.pause();
      this.player.jump(Number(row.dataset.at));
    });
    this.reset();
  }

  partOf(row) { return row[2] < 0 ? "–" : this.run.parts[row[2]].name; }
  whereOf([at, , , , , , to]) {
    return to >= 0 ? `motion ${to - 1}→${to}` : `${this.run.step.one} ${at}`;
  }

  makeHead() {
    this.head.replaceChildren(...this.columns.map((column, i) => {
      const cell = document.createElement("th");
      cell.scope = "col";
      if (column.numeric) cell.className = "n";
      const button = document.createElement("button");
      button.onclick = () => {
        this.sort = { column: i, descending: this.sort.column === i && !this.sort.descending };
        this.page = 0;
        this.draw();
      };
      cell.append(button);
      return cell;
    }));
  }

  /** Shows the current track. */
  reset() {
    this.track = this.player.track;
    const { findings } = this.track;
    const filters = [
      ["verdict", "Verdict", (row) => this.run.verdicts[row[1]].name, (row) => row[1]],
      ["part", "Part", (row) => this.partOf(row), (row) => row[2]],
      ["blade", "Blade", (row) => (row[3] < 0 ? "–" : bladeText(this.run, row[3])), (row) => row[3]],
    ];
    this.filters = filters;
    document.getElementById("filters").replaceChildren(...filters.map(([name, title, text, key]) => {
      const label = document.createElement("label"), select = document.createElement("select");
      select.id = `filter-${name}`;
      select.add(new Option("all", ""));
      const choices = new Map(findings.map((row) => [text(row), key(row)]));
      for (const [choice] of [...choices].sort((a, b) => a[1] - b[1])) select.add(new Option(choice, choice));
      select.value = choices.has(this.wanted[name]) ? this.wanted[name] : "";
      this.wanted[name] = select.value;
      select.onchange = () => { this.wanted[name] = select.value; this.page = 0; this.draw(); };
      label.append(`${title} `, select);
      return label;
    }));
    this.page = 0;
    this.draw();
  }

  turn(by) { this.page += by; this.draw(); document.querySelector(".rows").scrollTop = 0; }

  draw() {
    const { findings } = this.track;
    const column = this.columns[this.sort.column], sign = this.sort.descending ? -1 : 1;
    this.rows = findings.filter((row) => this.filters.every(([name, , text]) => !this.wanted[name] || text(row) === this.wanted[name]));
    this.rows.sort((a, b) => {
      const x = column.key(a), y = column.key(b);
      return sign * (x < y ? -1 : x > y ? 1 : 0) || a[0] - b[0];
    });
    [...this.head.children].forEach((cell, i) => {
      const sorted = i === this.sort.column;
      cell.setAttribute("aria-sort", sorted ? (this.sort.descending ? "descending" : "ascending") : "none");
      cell.firstChild.textContent = this.columns[i].name + (sorted ? (this.sort.descending ? " ▼" : " ▲") : "");
    });
    const from = this.page * kRows, rows = this.rows.slice(from, from + kRows);
    this.body.replaceChildren(...rows.map((row) => this.rowOf(row)));
    const many = this.rows.length > kRows;
    const count = `${this.rows.length} of ${findings.length}`;
    document.getElementById("shown").textContent = findings.length === 0 ? this.run.findings.none
      : many ? `${count}; rows ${from + 1} to ${from + rows.length} shown` : `${count} shown`;
    document.getElementById("pager").hidden = !many;
    document.getElementById("page-back").disabled = this.page === 0;
    document.getElementById("page-on").disabled = from + kRows >= this.rows.length;
    this.mark(false);
  }

  rowOf(row) {
    const element = document.createElement("tr");
    element.dataset.at = row[0];
    for (const column of this.columns) {
      const cell = element.insertCell();
      if (column.numeric) cell.className = "n";
      if (column.sign) { cell.className = "v"; cell.append(signSpan(this.run.verdicts[row[1]].tone)); }
      if (column.button) {
        const button = document.createElement("button");
        button.textContent = column.text(row);
        cell.className = "v";
        cell.append(button);
      } else {
        cell.append(column.text(row));
      }
    }
    return element;
  }

  /** Marks the row of the current place. */
  mark(scroll) {
    let marked = null;
    for (const row of this.body.children) {
      const here = Math.abs(Number(row.dataset.at) - this.player.at) < 1e-4;
      if (here) { row.setAttribute("aria-current", "true"); marked ??= row; } else row.removeAttribute("aria-current");
    }
    const box = document.querySelector(".rows");
    if (!marked || !scroll) return;
    const above = marked.offsetTop - this.head.offsetHeight, below = marked.offsetTop + marked.offsetHeight;
    if (above >= box.scrollTop && below <= box.scrollTop + box.clientHeight) return;
    box.scrollTop = above - (box.clientHeight - marked.offsetHeight) / 2; // centres the row
  }

  update() {
    if (this.track !== this.player.track) this.reset();
    if (this.player.playing) return;
    const index = this.rows.findIndex((row) => Math.abs(row[0] - this.player.at) < 1e-4);
    if (index >= 0 && Math.floor(index / kRows) !== this.page) { this.page = Math.floor(index / kRows); this.draw(); }
    this.mark(true);
  }
}
