// The run's record and its tables, as they stand in the page.

const run = JSON.parse(document.getElementById('run').textContent);

function typedArray(base64, Type) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  return new Type(bytes.buffer);
}

// A CSV of the run folder. Numbers that were not computed are NaN.
class Table {
  constructor(packed) {
    this.allRows = packed.rows;
    this.rows = packed.shown;
    this.names = packed.columns.map((c) => c.name);
    this.columns = new Map(packed.columns.map((c) => [c.name, Table.unpack(c)]));
  }

  static unpack(column) {
    if (column.numbers !== undefined)
      return typedArray(column.numbers, column.bits === 64 ? Float64Array : Float32Array);
    const places = typedArray(column.places, column.bits === 16 ? Uint16Array : Uint32Array);
    return Array.from(places, (place) => column.words[place]);
  }

  has(name) { return this.columns.has(name); }
  column(name) { return this.columns.get(name) ?? []; }
  // Different values in the order they come.
  values(name) { return [...new Set(this.column(name))]; }

  // Places of the rows whose columns have these values.
  where(conditions) {
    const tests = Object.entries(conditions).filter(([name]) => this.has(name));
    const columns = tests.map(([name, value]) => [this.column(name), value]);
    const rows = [];
    for (let row = 0; row < this.rows; ++row) {
      if (columns.every(([column, value]) => column[row] === value)) rows.push(row);
    }
    return rows;
  }
  pick(name, rows) {
    const column = this.column(name);
    return rows.map((row) => column[row]);
  }

  // Says so where not every row is in the page.
  get thinning() {
    return this.rows < this.allRows
      ? `${this.rows} of ${this.allRows} rows are drawn; of each stretch the extremes are kept.` : '';
  }
}

const tables = new Map(Object.entries(JSON.parse(document.getElementById('tables').textContent))
  .map(([name, packed]) => [name, new Table(packed)]));

const table = (name) => tables.get(name);
// An array of the record, empty where it has none.
const list = (value) => (Array.isArray(value) ? value : []);
const entries = (value) => (value && typeof value === 'object' ? Object.entries(value) : []);
