"use strict";
/// The views of the page: the findings, and the trades, each with its address.
nearmiss.views = (trades, addressOfFindings) => {
  const {element} = nearmiss.numbers, findings = document.getElementById("findings"), price = document.getElementById("price");
  const tabs = [{button: null, view: null}];
  let shown = tabs[0];

  function show(tab) {
    shown = tab;
    findings.hidden = tab.view !== null;
    price.hidden = tab.view === null;
    if (tab.view) price.replaceChildren(...tab.view.elements);
    for (const t of tabs) t.button.setAttribute("aria-pressed", String(t === tab));
    history.replaceState(null, "", `#${tab.view ? tab.address : addressOfFindings()}`);
  }
  function add(tab, text) {
    tab.button = element("button", {type: "button", "aria-pressed": String(tab === shown), onclick: () => show(tab)}, text);
    document.getElementById("views").append(tab.button);
  }
  function addTrade({name, trade}) {
    const tab = {name, address: ""};
    const choose = query => {
      tab.address = `price/${encodeURIComponent(name)}/${query}`;
      if (shown === tab) history.replaceState(null, "", `#${tab.address}`);
    };
    tab.view = nearmiss.tradeView(trade, choose);
    tab.view.elements[0].prepend(element("p", {class: "note"}, tab.view.description));
    tab.view.begin(null);
    tabs.push(tab);
    add(tab, `Price: ${name}`);
  }
  if (trades.length > 0) {
    add(tabs[0], "Findings");
    trades.forEach(addTrade);
  }

  /// Shows the trade of an address, "price/driving/ray_aabox"; does nothing for any other.
  function open(address) {
    const [kind, name, query] = address.split("/"), tab = tabs.find(t => t.view && encodeURIComponent(t.name) === name);
    if (kind !== "price" || !tab) return;
    tab.view.begin(query);
    show(tab);
  }
  /// The view of the shown trade; null where the findings are shown.
  return {open, shown: () => shown.view};
};
