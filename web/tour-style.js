// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The style of captions, hotspots, compass and plan. In an anaglyph, a spot is there twice, once for each eye: its plate
// darkens the channels of that eye only, and its words light them.
export const STYLE = `
#spots { position: absolute; inset: 0; overflow: hidden; pointer-events: none; }
.spot { position: absolute; width: 28px; height: 28px; min-height: 0; padding: 0; color: var(--text); font-weight: 600; pointer-events: auto; text-align: center; border-radius: 22px; background: var(--glass); border: 2px solid var(--text); }
.spot::before { content: ""; position: absolute; inset: -8px; border-radius: 50%; }
.spot > i { position: absolute; inset: -2px; border-radius: 22px; display: none; }
.spot > span { position: relative; white-space: nowrap; }
.spot:is(:hover, :focus-visible, [aria-expanded="true"]) { background: var(--accent); color: var(--solid); }
.way { width: max-content; max-width: min(240px, 60%); height: 34px; padding: 0 16px; font-size: 15px; }
.way::before { inset: -6px -2px; border-radius: 14px; }
.way > span { display: block; }
.away { clip-path: inset(50%); pointer-events: none; left: 50% !important; top: 50% !important; }
#aside { align-self: stretch; justify-content: space-between; }
#aside, #aside div, #aside button { display: flex; gap: 8px; min-width: 0; }
#aside div { flex-wrap: wrap; }
#aside div + div { justify-content: end; }
#aside button { align-items: center; max-width: min(280px, 44cqw); border-radius: 22px; font-weight: 600; pointer-events: auto; }
.way > span, #aside span { overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
#aside div:first-child button::before { content: "←"; }
#aside div + div button::after { content: "→"; }
.ring { position: absolute; border: 3px solid #fff; outline: 1px solid rgb(0 0 0 / 60%); outline-offset: -4px; border-radius: 50%; box-shadow: 0 0 0 1px rgb(0 0 0 / 60%); }
.spot:is(.red, .cyan) { background: none; border-color: transparent; }
.red > i, .cyan > i { display: block; mix-blend-mode: multiply; }
.red > span, .cyan > span { mix-blend-mode: screen; }
.red > i { background: #0ff; }
.red > span { color: #f00; }
.cyan > i { background: #f00; }
.cyan > span { color: #0ff; }
.ring:is(.red, .cyan) { mix-blend-mode: screen; box-shadow: none; outline: 0; }
.ring.red { border-color: #f00; }
.ring.cyan { border-color: #0ff; }
:is(#player.bare, #player:has(#title.bare #look[hidden])) #caption { top: 12px; }
#card { position: absolute; left: 0; top: 0; width: max-content; max-width: min(320px, 100% - 16px); padding: 10px 14px; border-radius: 10px; background: var(--solid); border: 1px solid var(--edge); overflow-wrap: anywhere; }
#card p { margin: 4px 0 0; white-space: pre-line; }
#card p:empty { display: none; }
#player:has(#compare) :is(#caption, #spots, #guide, #plan), .waiting :is(#guide, #plan, #aside) { display: none; }
#caption { position: absolute; left: 12px; top: var(--below); margin: 0; transition: opacity 0.3s; max-width: min(480px, 100% - 24px); padding: 4px 12px; border-radius: 10px; background: var(--glass); pointer-events: none; white-space: pre-line; }
#player:has(#guide) #caption { max-width: min(480px, 100% - 132px); }
#guide { position: absolute; right: max(12px, env(safe-area-inset-right)); top: var(--below); display: flex; flex-direction: column; align-items: end; gap: 8px; }
#guide button, #aside button { background: var(--glass); border: 1px solid var(--edge); }
#compass { width: 46px; height: 46px; padding: 0; border-radius: 50%; }
#compass svg { width: 44px; height: 44px; }
#compass path:first-child { fill: var(--accent); }
#compass text { font: 600 13px system-ui, sans-serif; }
#plan-toggle { border-radius: 999px; padding: 0 14px; }
#plan { position: absolute; right: max(12px, env(safe-area-inset-right)); top: calc(var(--below) + var(--side) + 66px); max-width: min(240px, 60cqw); padding: 6px; border-radius: 12px; background: var(--glass); border: 1px solid var(--edge); }
.map { position: relative; overflow: hidden; border-radius: 7px; }
.map img { display: block; max-width: 100%; background: #fff; }
.dot { position: absolute; width: 28px; height: 28px; min-height: 0; margin: -14px; padding: 0; border-radius: 50%; }
.dot::after { content: ""; position: absolute; inset: 7px; border-radius: 50%; background: #1b1c1e; border: 2px solid #fff; }
.dot:hover::after, .dot[aria-current="true"]::after { background: #c25e00; }
.cone { --wide: 90deg; position: absolute; width: 96px; height: 96px; margin: -48px; border-radius: 50%; pointer-events: none; background: conic-gradient(from calc(var(--wide) / -2), rgb(194 94 0 / 62%) var(--wide), transparent 0); mask: radial-gradient(#000 30%, transparent 70%); }
@media (pointer: coarse) {
  .spot:not(.way) { width: 36px; height: 36px; }
  .way { height: 44px; }
}
@media (forced-colors: active) {
  #card, .spot, #aside button, .dot::after { border: 1px solid ButtonText; }
  .dot[aria-current="true"]::after { background: Highlight; forced-color-adjust: none; }
}`;
